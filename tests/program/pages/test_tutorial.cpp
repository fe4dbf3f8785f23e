// Tests the pages whose commands a reader runs: they are run as they stand, in a fresh folder.
#include "tests/program/pages/page_script.hpp"

namespace tactus {
namespace {

constexpr PageScript kCommands{"$R/tests/program/pages/try_tutorial.py "};

// Proves DOC-1.

void the_pages_print_what_they_say(void**) {
  for (const char* page : {"docs/tutorial.md", "docs/commissioning.md", "docs/recordings.md"})
    kCommands.assert_true_of(page);
}

void a_page_that_says_anything_else_is_found(void**) {
  constexpr struct {
    const char *text, *complaint;
  } kPages[] = {
      {"```sh\necho 12\n```\n\n```text\n1...3\n```\n", "page.md:1:"},
      {"A line.\n```sh\nexit 3\n```\n", "page.md:2: exit code 3"},
      {"```sh\necho 12\n```\n", "Got:"},
      {"```sh\ntrue\n```\n```text\n12\n```\n", "Expected:"},
      {"No block.\n", "page.md: no commands"},
  };
  for (const auto& [text, complaint] : kPages) {
    write("page.md", {text});
    kCommands.assert_finds(complaint);
  }
  write("page.md", {"```sh\necho 123; echo 4 >&2\n```\n\n```text\n1...3\n4\n```\n"});
  kCommands.assert_true_of("$S/page.md");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_pages_print_what_they_say),
      cmocka_unit_test(a_page_that_says_anything_else_is_found),
  };
  return run_program_tests(argv[0], tests);
}
