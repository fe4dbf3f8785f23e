// Tests the page of mistakes: each is made, and the program prints what the page says.
#include "tests/program/pages/page_script.hpp"

namespace tactus {
namespace {

constexpr PageScript kMistakes{"$R/tests/program/pages/try_mistakes.py "};

/// A page with one row for the board of this program.
void write_page(const char* row) {
  write("page.md", {"\n## File\n\n`tactus check p.ini`\n\n", row,
                    "\n## File, board `ur10_socket`\n\n`tactus check p.ini`\n\n", row});
}

// Proves DOC-2.

void every_mistake_is_answered_as_the_page_says(void**) {
  kMistakes.assert_true_of("docs/mistakes.md");
}

void a_page_that_says_anything_else_is_found(void**) {
  constexpr struct {
    const char *row, *complaint;
  } kPages[] = {
      {"| no pipeline: none | `p.ini: Not there; give it` | |\n",
       "no pipeline:\n  expected p.ini: Not"},
      {"| no pipeline: none | `p.ini: No such file ...` | |\n",
       "no pipeline: the line has no remedy"},
      {"| no pipeline: exit code 1 | `p.ini...; ...` | |\n",
       "no pipeline: exit code 2, expected 1"},
      {"| no row |\n", "no mistake for the board"},
  };
  for (const auto& [row, complaint] : kPages) {
    write_page(row);
    kMistakes.assert_finds(complaint);
  }
  write_page("| no pipeline: none | `p.ini: No such file or directory; ...` | |\n");
  kMistakes.assert_true_of("$S/page.md");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_mistake_is_answered_as_the_page_says),
      cmocka_unit_test(a_page_that_says_anything_else_is_found),
  };
  return run_program_tests(argv[0], tests);
}
