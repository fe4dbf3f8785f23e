// Tests that gateway/tactus.proto, as text, names what the kernel's tables number: whoever has only
// the protocol knows every rung, phase and code, and none that is not there.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"
#include "kernel/cycle/rung.hpp"
#include "kernel/reference/motion/motion_phase.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

using Word = Text<63>;

/// The enumerators of an enumeration of the protocol, by number.
struct Enumeration {
  std::array<Word, 256> names;
  int count = 0;

  explicit Enumeration(const char* name, const char* prefix) {
    std::FILE* const file = std::fopen("gateway/tactus.proto", "r");
    assert_non_null(file);
    char line[256];
    bool inside = false;
    while (std::fgets(line, sizeof line, file) != nullptr) {
      char word[64] = "";
      int number = -1;
      if (std::sscanf(line, "enum %63s {", word) == 1) inside = std::strcmp(word, name) == 0;
      if (inside && line[0] == '}') inside = false;
      if (!inside || std::sscanf(line, " %63[A-Z_0-9] = %d;", word, &number) != 2) continue;
      assert_in_range(number, 0, 255);
      assert_int_equal(std::strncmp(word, prefix, std::strlen(prefix)), 0);
      names[static_cast<std::size_t>(number)] = Word(word + std::strlen(prefix));
      ++count;
    }
    std::fclose(file);
    assert_true(count > 0);
  }
};

/// "skip_optional" and "kNotOwner" as the protocol writes them: SKIP_OPTIONAL, NOT_OWNER.
Word capitals(const char* name) {
  Word text;
  if (name[0] == 'k' && std::isupper(static_cast<unsigned char>(name[1])) != 0) ++name;
  for (const char* at = name; *at != '\0'; ++at) {
    const auto letter = static_cast<unsigned char>(*at);
    if (at != name && std::isupper(letter) != 0) text << "_";
    const char capital = static_cast<char>(std::toupper(letter));
    text << std::string_view(&capital, 1);
  }
  return text;
}

template <class E>
void assert_names_all_of(const Enumeration& told) {
  assert_int_equal(told.count, kNames<E>.size());
  for (std::size_t i = 0; i < kNames<E>.size(); ++i)
    assert_string_equal(told.names[i].c_str(), capitals(kNames<E>[i]).c_str());
}

// Proves GW-14.

void the_rungs_of_the_protocol_are_those_of_the_ladder(void**) {
  assert_names_all_of<Rung>(Enumeration("Rung", "RUNG_"));
}

void the_phases_of_the_protocol_are_those_of_the_motion(void**) {
  assert_names_all_of<MotionPhase>(Enumeration("Phase", "PHASE_"));
}

void the_codes_of_the_protocol_are_the_statuses_of_the_kernel(void**) {
  const Enumeration told("Code", "CODE_");
  for (int number = 0; number < 256; ++number) {
    const char* const ours = name(static_cast<Status>(number));
    const bool known = std::strcmp(ours, "unknown") != 0;
    assert_string_equal(told.names[static_cast<std::size_t>(number)].c_str(),
                        known ? capitals(ours).c_str() : "");
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_rungs_of_the_protocol_are_those_of_the_ladder),
      cmocka_unit_test(the_phases_of_the_protocol_are_those_of_the_motion),
      cmocka_unit_test(the_codes_of_the_protocol_are_the_statuses_of_the_kernel),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
