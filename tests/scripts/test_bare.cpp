// Tests scripts/bare with a fake debootstrap, whose system is busybox. Runs from the root of the
// project; a system is made only by root.
#include <unistd.h>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kDebootstrap =
    "#!/bin/sh\n[ ! -e $S/fails ] || { echo 'E: no mirror'; exit 1; }\n"
    "mkdir -p $3/etc/apt/apt.conf.d $3/bin $3/usr/bin $3/root $3/proc $3/sys $3/dev\n"
    "cp $(command -v busybox) $3/bin/busybox\n"
    "for name in sh cat ls mkdir touch sleep mount; do ln -s busybox $3/bin/$name; done\n"
    "ln -s ../../bin/busybox $3/usr/bin/env\n";
constexpr const char* kApt =
    "#!/bin/sh\ncase \"$*\" in *Component*) echo 'deb here bookworm main' ;; *) echo here ;; "
    "esac\n";
constexpr const char* kGit =
    "#!/bin/sh\ncase \"$*\" in *clone*) for last; do :; done; mkdir -p $last; "
    "echo committed >$last/file ;; esac\n";

/// Fakes: debootstrap fails if $S/fails exists; a clone has one file; nothing is missing.
int plant(void**) {
  shell("mkdir $S/bin $S/tmp");
  write("bin/debootstrap", {kDebootstrap});
  write("bin/apt-get", {kApt});
  write("bin/git", {kGit});
  write("bin/dpkg-query", {"#!/bin/sh\necho all installed\n"});
  write("bin/id", {"#!/bin/sh\necho ${USER_ID:-0}\n"});
  return shell("chmod +x $S/bin/*");
}

int bare(const char* words, const char* before = "") {
  Line line(before);
  return shell(
      (line << " PATH=$S/bin:$PATH TMPDIR=$S/tmp SECRET=1 scripts/bare " << words).c_str());
}

/// Whether nothing is left: no folder, no mount, and no process that sleeps for this long.
void assert_nothing_is_left() {
  assert_succeeds("[ -z \"$(ls $S/tmp)\" ]");
  assert_succeeds("! grep $S/tmp /proc/mounts >&2");
  assert_succeeds("! grep -l '^sleep.4321' /proc/[0-9]*/cmdline >&2");
}

void need_root() {
  if (geteuid() != 0) _skip(__FILE__, __LINE__);
}

// Proves CHK-5.

void what_cannot_run_is_refused_with_reason_and_remedy(void**) {
  assert_int_equal(bare("true", "USER_ID=1000"), 2);
  assert_true(has(errors(), "bare: only root can make a system; run it as root"));
  assert_int_equal(bare(""), 2);
  assert_true(has(errors(), "bare: no command; for example: bare sh -c"));
  assert_int_equal(bare("--keeps x true"), 2);
  assert_true(has(errors(), "bare: '--keeps' is no option; bare --help says what there is"));
  assert_int_equal(bare("--keep $S/bin true"), 2);
  assert_true(has(errors(), "/bin exists; name a folder that does not"));
  assert_int_equal(bare("--keep $S/none/kept true"), 2);
  assert_true(has(errors(), "there is no folder "));
  assert_int_equal(bare("--help"), 0);
  assert_true(has(output(), "bare --keep ../bare make "));
  assert_nothing_is_left();
}

void a_command_has_the_clone_and_nothing_of_this_shell(void**) {
  need_root();
  assert_int_equal(bare("sh -c 'cat file; echo $SECRET.$HOME.; ls /proc/self/fd /dev/shm'"), 0);
  assert_true(has(output(), "committed\n./root.\n"));
  assert_true(has(output(), "bare: exit code 0 after "));
  assert_int_equal(bare("sh -c 'echo $@; exit 42' sh 'two words'"), 42);
  assert_true(has(output(), "\ntwo words\n"));
  assert_nothing_is_left();
}

void the_clone_is_kept_however_the_command_ends(void**) {
  need_root();
  assert_int_equal(bare("--keep $S/kept sh -c 'mkdir build; touch build/log; exit 3'"), 3);
  assert_succeeds("test -e $S/kept/build/log && rm -r $S/kept");
  assert_nothing_is_left();
}

void nothing_is_left_after_an_end_of_any_kind(void**) {
  need_root();
  assert_int_equal(bare("sh -c 'sleep 4321 & exit 5'"), 5);
  assert_nothing_is_left();
  constexpr const char* kEnds[][2] = {{"INT", "130"}, {"TERM", "143"}};
  for (const auto& [signal, code] : kEnds) {
    setenv("HOW", signal, 1);
    setenv("CODE", code, 1);
    assert_succeeds(
        "PATH=$S/bin:$PATH TMPDIR=$S/tmp env --default-signal=INT scripts/bare sh -c "
        "'echo on; sleep 4321' >$S/said & "
        "until grep -qx on $S/said; do sleep 0.1; done; kill -$HOW $!; wait $!; test $? = $CODE");
    assert_nothing_is_left();
  }
}

void a_system_that_cannot_be_made_says_why(void**) {
  need_root();
  write("fails", {});
  assert_int_equal(bare("true"), 2);
  assert_true(has(errors(), "E: no mirror\nbare: debootstrap failed; the end of its output"));
  std::remove(in_folder("fails").c_str());
  assert_nothing_is_left();
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_cannot_run_is_refused_with_reason_and_remedy),
      cmocka_unit_test(a_command_has_the_clone_and_nothing_of_this_shell),
      cmocka_unit_test(the_clone_is_kept_however_the_command_ends),
      cmocka_unit_test(nothing_is_left_after_an_end_of_any_kind),
      cmocka_unit_test(a_system_that_cannot_be_made_says_why),
  };
  if (!find_program(argv[0], "tactus")) return 1;
  return cmocka_run_group_tests(tests, plant, remove_folder);
}
