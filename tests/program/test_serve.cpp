// Tests `tactus serve` as a program: its clients speak over its socket, in Python.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kServed =
    "[robot]\nname = fer\nperiod_us = 4000\ntau_c = pd.tau\n"
    "[executive]\nmax_slip = 1000\nmax_late = 16\nlate_window = 1\nmax_overruns = 16\n"
    "overrun_window = 1\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\nonline = limit\n"
    "goal_tolerance = 0.2\nstopped_velocity = 0\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n";

void try_server(const char* what) {
  write("served.ini", {kServed});
  Line command("cd $R && mkdir -p $S/");
  command << what << " && tests/gateway/try_server.py $P $S/served.ini $S/" << what << " " << what;
  const int code = shell(command.c_str());
  if (code != 0) print_error("%.*s\n", static_cast<int>(errors().size()), errors().data());
  assert_int_equal(code, 0);
}

// Proves GW-9.

void a_client_in_python_moves_the_arm_and_is_told_of_it(void**) {
  try_server("session");
}

void clients_that_are_killed_leave_the_arm_at_rest(void**) {
  try_server("killed");
}

void an_interrupt_brakes_the_arm_and_ends_the_server_well(void**) {
  try_server("interrupted");
}

void addresses_of_other_kinds_are_refused(void**) {
  const Line pipeline = write("served.ini", {kServed});
  constexpr struct {
    const char *address, *reason;
  } kCases[] = {
      {"tcp:0.0.0.0:7370", "programs on other computers would reach it"},
      {"tcp:192.168.1.5:7370", "programs on other computers would reach it"},
      {"tcp:127.0.0.1", "is no IPv4 address and port"},
      {"tcp:127.0.0.1:99999", "is no IPv4 address and port"},
      {"udp:127.0.0.1:7370", "is neither unix:PATH nor tcp:ADDRESS:PORT"},
      {"unix:", "the path of a Unix socket has 1 to"},
      {"unix:/nowhere/arm.sock", "/nowhere/arm.sock: No such file or directory"},
  };
  for (const auto& [address, reason] : kCases) {
    assert_int_equal(tactus_run({"serve", pipeline.c_str(), "--listen", address}), 2);
    assert_true(has(errors(), reason));
  }
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_client_in_python_moves_the_arm_and_is_told_of_it),
      cmocka_unit_test(clients_that_are_killed_leave_the_arm_at_rest),
      cmocka_unit_test(an_interrupt_brakes_the_arm_and_ends_the_server_well),
      cmocka_unit_test(addresses_of_other_kinds_are_refused),
  };
  return run_program_tests(argv[0], tests);
}
