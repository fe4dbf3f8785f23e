// The checking tools must be able to fail: each is shown a planted violation. Runs from the root of
// the project.
#include <cstdio>
#include <cstdlib>

#include "tests/testing.hpp"

namespace {

/// Writes `text` to `path` below a fresh scratch folder, whose name is left in `folder`.
void plant(const char* path, const char* text, char (&folder)[64]) {
  std::snprintf(folder, sizeof folder, "/tmp/tactus-XXXXXX");
  assert_non_null(mkdtemp(folder));
  char command[512], file[256];
  std::snprintf(file, sizeof file, "%s/%s", folder, path);
  std::snprintf(command, sizeof command, "mkdir -p $(dirname %s)", file);
  assert_int_equal(std::system(command), 0);
  std::FILE* stream = std::fopen(file, "w");
  assert_non_null(stream);
  std::fputs(text, stream);
  std::fclose(stream);
}

/// Runs a command in which %s stands for `folder`; true if it ended with exit code 0.
[[gnu::format(printf, 1, 0)]] bool passes(const char* command, const char* folder) {
  char text[1024];
  std::snprintf(text, sizeof text, command, folder);
  return std::system(text) == 0;
}

// Proves KER-2.

void the_tree_keeps_its_layers(void**) {
  assert_int_equal(std::system("scripts/layers"), 0);
}

void an_include_across_the_layers_is_found(void**) {
  const char* violations[][2] = {
      {"kernel/control/law.hpp", "#include \"hal/can/socketcan.hpp\"\n"},
      {"kernel/control/law.hpp", "#include <vector>\n"},
      {"kernel/control/law.hpp", "#include <sys/socket.h>\n"},
      {"kernel/control/law.hpp", "#include \"kernel/control/pd_gravity.hpp\"\n"},
      {"kernel/math/x.hpp", "#include \"tests/testing.hpp\"\n"},
      {"sim_plant/arm.hpp", "#include \"kernel/pipeline.hpp\"\n"},
      {"gateway/server.hpp", "#include \"boards/program/session.hpp\"\n"},
      {"hal/ur/x.hpp", "#include \"sim_plant/arm.hpp\"\n"},
  };
  for (const auto& [path, text] : violations) {
    char folder[64];
    plant(path, text, folder);
    assert_false(passes("scripts/layers %s 2>/dev/null", folder));
  }
}

void an_allowed_include_is_not_complained_of(void**) {
  char folder[64];
  plant("kernel/control/law.hpp", "#include <array>\n#include \"kernel/port.hpp\"\n", folder);
  assert_true(passes("scripts/layers %s", folder));
}

// Proves KER-1.

void a_heap_call_in_an_archive_is_found(void**) {
  const char* violations[] = {
      "#include <vector>\nint f(int n) { std::vector<int> v; v.push_back(n); return v[0]; }\n",
      "#include <cstdlib>\nvoid* f() { return std::malloc(8); }\n",
      "void f() { throw 1; }\n",
      "#include <cstdio>\nvoid f() { std::puts(\"\"); }\n",
      "#include <ctime>\nlong f() { return std::time(nullptr); }\n",
      "#include <cmath>\ndouble f(double x) { return std::sin(x); }\n",
  };
  for (const char* text : violations) {
    char folder[64];
    plant("x.cpp", text, folder);
    assert_true(passes("cd %s && g++ -O3 -c x.cpp && ar rcs x.a x.o", folder));
    assert_false(passes("scripts/no_heap %s/x.a 2>/dev/null", folder));
  }
}

void a_pure_archive_is_not_complained_of(void**) {
  char folder[64];
  plant("x.cpp", "#include <cmath>\ndouble f(double x) { return std::sqrt(x * x + 1); }\n", folder);
  assert_true(passes("cd %s && g++ -O3 -c x.cpp && ar rcs x.a x.o", folder));
  assert_true(passes("scripts/no_heap %s/x.a", folder));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_tree_keeps_its_layers),
      cmocka_unit_test(an_include_across_the_layers_is_found),
      cmocka_unit_test(an_allowed_include_is_not_complained_of),
      cmocka_unit_test(a_heap_call_in_an_archive_is_found),
      cmocka_unit_test(a_pure_archive_is_not_complained_of),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
