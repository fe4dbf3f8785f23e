// Tests what `make install` leaves behind: a program that knows its version, draws its figures, and
// has a man page and a completion made from its own help. Runs from the root of the project.
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// True if a shell command succeeds; $at is a folder of this process, $bin the installed program.
bool passes(const char* command) {
  static char line[1024];
  std::snprintf(line, sizeof line, "at=/tmp/tactus-install-%d; bin=$at/opt/bin/tactus-fer_sim; %s",
                static_cast<int>(getpid()), command);
  return std::system(line) == 0;
}

int install(void**) {
  const bool installed = passes(
      "env -u MAKEFLAGS make -s BOARD=fer_sim install DESTDIR=$at PREFIX=/opt >$at.log 2>&1 || "
      "cat $at.log; test -x $bin");
  return installed ? 0 : 1;
}

int remove_installation(void**) {
  return passes("rm -rf $at $at.log") ? 0 : 1;
}

// Proves RUN-9.

void the_program_says_its_version_and_board(void**) {
  assert_true(passes("$bin --version | grep -q '^tactus 0[.]1.*, board '"));
}

void an_installed_program_draws_its_figure(void**) {
  assert_true(
      passes("$bin run $at/opt/share/tactus/pipelines/fer_trg_cpc.ini --duration 0.1 "
             "--out $at/run >/dev/null; test -s $at/run/figure.png"));
}

void the_man_page_has_every_verb_and_the_exit_codes(void**) {
  assert_true(
      passes("for word in run check ports doctor jitter 'Exit codes' period; do grep -q "
             "\"$word\" $at/opt/share/man/man1/*.1 || exit 1; done"));
}

void the_completion_knows_verbs_and_their_options(void**) {
  constexpr const char* kAsk =
      "bash -c '. $1; COMP_WORDS=(tactus $2 $3); COMP_CWORD=$4; "
      "$(complete -p | sed \"s/.*-F //; s/ .*//\"); test \"${COMPREPLY[*]}\" = \"$5\"' - "
      "$at/opt/share/bash-completion/completions/tactus-* ";
  char command[512];
  std::snprintf(command, sizeof command, "%s do '' 1 doctor", kAsk);
  assert_true(passes(command));
  std::snprintf(command, sizeof command, "%s run --dur 2 --duration", kAsk);
  assert_true(passes(command));
}

/// A folder with blanks and a quote; the program draws its figure from there too.
void a_prefix_may_be_any_name_of_a_folder(void**) {
  assert_true(passes(
      "p=\"/a 'b' c\"; env -u MAKEFLAGS make -s BOARD=fer_sim install DESTDIR=$at PREFIX=\"$p\" "
      ">$at.log 2>&1 || cat $at.log; \"$at$p/bin/tactus-fer_sim\" run "
      "\"$at$p/share/tactus/pipelines/fer_trg_cpc.ini\" --duration 0.1 --out \"$at/r 1\" "
      ">/dev/null; test -s \"$at/r 1/figure.png\" && "
      "test -s \"$at$p/share/man/man1/tactus-fer_sim.1\""));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_program_says_its_version_and_board),
      cmocka_unit_test(an_installed_program_draws_its_figure),
      cmocka_unit_test(the_man_page_has_every_verb_and_the_exit_codes),
      cmocka_unit_test(the_completion_knows_verbs_and_their_options),
      cmocka_unit_test(a_prefix_may_be_any_name_of_a_folder),
  };
  return cmocka_run_group_tests(tests, install, remove_installation);
}
