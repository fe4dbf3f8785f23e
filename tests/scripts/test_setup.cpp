// Tests scripts/setup with fakes of dpkg-query, apt-get and id. Runs from the root of the project.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kDpkg =
    "#!/bin/sh\ngrep -qx \"$4\" $S/missing && exit 1\n"
    "echo \"$(dpkg --print-architecture) installed\"\n";
constexpr const char* kApt =
    "#!/bin/sh\necho \"$*\" >>$S/words\n"
    "if [ -e $S/locked ] && expr \"$*\" : \".*$(cat $S/locked)\" >/dev/null; then rm $S/locked\n"
    "  echo 'E: Could not get lock /var/lib/dpkg/lock-frontend. It is held by process 7 (apt)'\n"
    "  exit 100\nfi\n"
    "case \"$*\" in\n"
    "*--assume-no*) echo '0 upgraded, 7 newly installed, 0 to remove and 133 not upgraded.'\n"
    "  echo 'Need to get 45.5 MB of archives.'\n"
    "  echo 'After this operation, 159 MB of additional disk space will be used.'; exit 1 ;;\n"
    "*--download-only*) if [ -e $S/fails ]; then echo 'E: no network'; exit 100; fi ;;\n"
    "esac\necho noise\n";

/// Fakes: packages are missing if their names are in $S/missing. apt-get notes its words in
/// $S/words, and cannot download if $S/fails exists.
int plant(void**) {
  shell("mkdir $S/bin");
  write("bin/dpkg-query", {kDpkg});
  write("bin/apt-get", {kApt});
  write("bin/id", {"#!/bin/sh\necho $USER_ID\n"});
  return shell("chmod +x $S/bin/*");
}

int setup(const char* words, const char* missing, const char* user = "0") {
  write("missing", {missing});
  write("words", {});
  setenv("USER_ID", user, 1);
  return shell((Line("PATH=$S/bin:$PATH scripts/setup ") << words).c_str());
}

// Proves RUN-13.

void where_nothing_is_missing_nothing_is_said_and_nothing_called(void**) {
  for (const char* words : {"", "test", "check", "wcet", "report", "m7", "bare"}) {
    assert_int_equal(setup(words, "\n"), 0);
    assert_true(output().empty() && errors().empty() && file_of("words").empty());
  }
}

void it_says_what_it_downloads_before_it_does_and_one_line_per_phase(void**) {
  assert_int_equal(setup("", "help2man\nlibfcl-dev\nchromium\n"), 0);
  const std::string_view said = output();
  constexpr std::string_view kSaid =
      "setup: missing: libfcl-dev help2man\n"
      "setup: reading the lists of packages\n"
      "setup: 2 packages, 7 with what they need: 45.5 MB to download, 159 MB on the disk\n"
      "setup: downloading\nsetup: installing\nsetup: done in ";
  assert_true(has(said.substr(0, kSaid.size()), kSaid));
  assert_true(errors().empty());
  assert_true(file_of("words") ==
              "update -q\n"
              "install --assume-no --no-install-recommends libfcl-dev help2man\n"
              "install -q -y --no-install-recommends --download-only libfcl-dev help2man\n"
              "install -q -y --no-install-recommends libfcl-dev help2man\n");
}

void each_word_adds_its_packages(void**) {
  assert_int_equal(setup("report", "chromium\nvalgrind\n"), 0);
  assert_true(has(output(), "setup: missing: chromium\n"));
  assert_int_equal(setup("wcet", "chromium\nvalgrind\nclang-tidy\n"), 0);
  assert_true(has(output(), "setup: missing: valgrind\n"));
  assert_int_equal(setup("check", "chromium\nvalgrind\nclang-tidy\n"), 0);
  assert_true(has(output(), "setup: missing: valgrind clang-tidy\n"));
  assert_int_equal(setup("test", "chromium\nvalgrind\nopenssl\ntshark\nclang-tidy\n"), 0);
  assert_true(has(output(), "setup: missing: valgrind tshark openssl\n"));
  assert_int_equal(setup("bare", "make\ndebootstrap\n"), 0);
  assert_true(has(output(), "setup: missing: debootstrap\n"));
}

void a_phase_that_fails_shows_why_and_ends_it(void**) {
  write("fails", {});
  assert_int_equal(setup("", "make\n"), 1);
  assert_true(has(errors(), "E: no network\nsetup: apt-get install failed; its output is above\n"));
  assert_true(output().find("installing") == std::string_view::npos);
  std::remove(in_folder("fails").c_str());
}

/// In every phase; none fails, and the sizes are known.
void another_program_that_installs_is_waited_for(void**) {
  for (const char* call : {"update", "assume-no", "download-only", "-y --no-install"}) {
    write("locked", {call});
    assert_int_equal(setup("", "make\n"), 0);
    assert_true(
        has(output(), " waits for process 7 (apt), which holds the lock of the packages\n"));
    assert_true(has(output(), "setup: 1 packages, 7 with what they need: 45.5 MB to download"));
  }
}

void who_is_not_root_gets_the_command(void**) {
  assert_int_equal(setup("", "make\nhelp2man\n", "1000"), 1);
  assert_true(errors() ==
              "setup: packages are missing; run as root: apt-get install make help2man\n");
  assert_true(file_of("words").empty());
}

void help_lists_the_words_and_any_other_is_refused(void**) {
  assert_int_equal(setup("--help", "make\n"), 0);
  assert_has_all(output(), {"setup check ", "setup wcet ", "setup report ", "`make film`"});
  assert_int_equal(setup("everything", "make\n"), 2);
  assert_true(has(errors(),
                  "setup: 'everything' is none of test, check, wcet, wheel, report, "
                  "vm, "));
  assert_true(file_of("words").empty());
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(where_nothing_is_missing_nothing_is_said_and_nothing_called),
      cmocka_unit_test(it_says_what_it_downloads_before_it_does_and_one_line_per_phase),
      cmocka_unit_test(each_word_adds_its_packages),
      cmocka_unit_test(a_phase_that_fails_shows_why_and_ends_it),
      cmocka_unit_test(another_program_that_installs_is_waited_for),
      cmocka_unit_test(who_is_not_root_gets_the_command),
      cmocka_unit_test(help_lists_the_words_and_any_other_is_refused),
  };
  if (!find_program(argv[0], "tactus")) return 1;
  return cmocka_run_group_tests(tests, plant, remove_folder);
}
