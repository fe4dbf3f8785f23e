// Tests scripts/beside_emulator, started as `make run` starts it, with the emulated controller and
// a program that replaces ur10_socket's and reports its arguments.
#include <csignal>
#include <ctime>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kName = "pipelines/ur10_trg_cpc_real.ini";
// Connects to the address in its file and writes that address to a file of its own.
constexpr const char* kProgram =
    "#!/usr/bin/python3\n"
    "import pathlib, re, socket, sys, time\n"
    "text = open(sys.argv[2]).read()\n"
    "assert 'keep = this' in text and (pathlib.Path(sys.argv[2]).parent / "
    "'trajectories/t').exists()\n"
    "assert text.count('packet_wait') == 1 and 'packet_wait = 500\\n' in text\n"
    "address = re.search(r'address = (\\S+)', text).group(1)\n"
    "socket.create_connection((address, 30004), 5).close()\n"
    "open('said', 'a').write(address + '\\n')\n"
    "time.sleep(float(sys.argv[3]))\n"
    "sys.exit(int(sys.argv[4]))\n";

/// Runs a shell command in the scratch folder.
int shell_there(const char* command) {
  Text<4095> line("cd $S && ");
  line << command;
  return shell(line.c_str());
}

void plant(const char* address) {
  assert_int_equal(
      shell_there(
          "rm -f said && mkdir -p build/ur10_socket build/ur10_emulator pipelines/trajectories && "
          "touch pipelines/trajectories/t && ln -sf $P build/ur10_emulator/ur10_emulator"),
      0);
  write(kName,
        {"[robot]\nname = ur10\nperiod_us = 8000\n[ur]\n", address, "[other]\nkeep = this\n"});
  write("build/ur10_socket/tactus", {kProgram});
  assert_int_equal(shell_there("chmod +x build/ur10_socket/tactus"), 0);
}

/// Asserts that no server is left at the addresses the programs connected to.
void assert_nobody_is_left() {
  assert_int_equal(shell_there("/usr/bin/python3 -c \"import socket\n"
                               "for line in open('said'):\n"
                               "    door = socket.socket()\n"
                               "    assert door.connect_ex((line.strip(), 30004)) != 0\""),
                   0);
}

// Proves URH-21.

void the_program_meets_an_emulator_that_ends_with_it(void**) {
  plant("address = 192.168.1.10    # of the controller\n");
  assert_int_equal(
      shell_there("$R/scripts/beside_emulator run pipelines/ur10_trg_cpc_real.ini 0 3"), 3);
  assert_true(has(file_of("said"), "127.0.0."));
  assert_nobody_is_left();
}

void two_at_once_have_one_each(void**) {
  plant("address = 192.168.1.10\n");
  assert_int_equal(
      shell_there("run=\"$R/scripts/beside_emulator run pipelines/ur10_trg_cpc_real.ini\"\n"
                  "$run 1 0 & $run 1 0 && wait && [ $(sort -u said | wc -l) = 2 ]"),
      0);
  assert_nobody_is_left();
}

void an_interrupt_ends_both(void**) {
  for (const int signal : {SIGINT, SIGTERM}) {
    plant("address = 192.168.1.10\n");
    char words[3][160] = {"sh", "-c",
                          "cd $S && exec $R/scripts/beside_emulator run "
                          "pipelines/ur10_trg_cpc_real.ini 60 0 2>$S/err"};
    char* const arguments[] = {words[0], words[1], words[2], nullptr};
    pid_t child = 0;
    assert_int_equal(posix_spawn(&child, "/bin/sh", nullptr, nullptr, arguments, environ), 0);
    for (int i = 0; i < 60'000 && file_of("said").empty(); ++i) {
      const timespec millisecond = {0, 1'000'000};
      nanosleep(&millisecond, nullptr);
    }
    assert_int_equal(kill(child, signal), 0);
    assert_int_equal(exit_code(child), 128 + signal);
    assert_nobody_is_left();
  }
}

void what_cannot_be_run_is_said(void**) {
  plant("");
  assert_int_equal(shell_there("$R/scripts/beside_emulator run pipelines/ur10_trg_cpc_real.ini"),
                   2);
  assert_true(has(errors(), "ur10_trg_cpc_real.ini: 0 lines with an address; expected 1"));
  assert_int_equal(shell_there("$R/scripts/beside_emulator run pipelines/other.ini"), 2);
  assert_true(has(errors(), "other.ini: no start position; pipelines with one: "));
  assert_int_equal(shell_there("rm build/ur10_emulator/ur10_emulator; "
                               "$R/scripts/beside_emulator run pipelines/ur10_trg_cpc_real.ini"),
                   2);
  assert_true(has(errors(), "build/ur10_emulator/ur10_emulator: No such file or directory"));
}

}  // namespace
}  // namespace tactus

int main(int, char** arguments) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_program_meets_an_emulator_that_ends_with_it),
      cmocka_unit_test(two_at_once_have_one_each),
      cmocka_unit_test(an_interrupt_ends_both),
      cmocka_unit_test(what_cannot_be_run_is_said),
  };
  return run_program_tests(arguments[0], tests, "ur10_emulator");
}
