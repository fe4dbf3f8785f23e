// Tests the Python client by the modules in tests/gateway/python: against a server that is written
// from the protocol alone and may misbehave, and against the server of this board.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

#ifdef TACTUS_SANITIZED
constexpr const char* kSettings = "TACTUS_KILLS=10 ";  // the usual number would take minutes
#else
constexpr const char* kSettings = "";
#endif

/// Runs the tests of a module; $P is the program that serves.
void run_module(const char* module) {
  Line command("PYTHONPATH=$R/build/python:$R/gateway/python/examples:$R/tests/gateway/python ");
  command << kSettings << "/usr/bin/python3 -m unittest ";
  const int code = shell((command << module).c_str());
  if (code != 0) print_error("%.*s\n", static_cast<int>(errors().size()), errors().data());
  assert_int_equal(code, 0);
}

// Proves PYT-1, PYT-2, PYT-3.

void the_client_sends_and_understands_what_the_protocol_says(void**) {
  run_module("test_messages");
}

void trajectories_are_sent_as_the_protocol_says(void**) {
  run_module("test_trajectories");
}

void streams_are_sent_as_the_protocol_says(void**) {
  run_module("test_streams");
}

// Proves PYT-4.

void a_server_that_does_not_keep_to_the_protocol_is_named_in_time(void**) {
  run_module("test_hostile");
}

// Proves PYT-5.

void the_clock_of_the_server_is_followed(void**) {
  run_module("test_clock");
}

// Proves PYT-6, PYT-9, PYT-10, PYT-12.

void a_simulated_robot_is_moved_in_all_ways(void**) {
  run_module("test_robot");
}

void a_server_is_started_with_a_key_and_in_virtual_time(void**) {
  run_module("test_serving");
}

// Proves PYT-11.

void parameters_change_while_the_arm_moves(void**) {
  run_module("test_parameters");
}

// Proves PYT-7.

void every_example_runs(void**) {
  run_module("test_examples");
}

// Proves PYT-13, PYT-14.

void the_package_is_installed_by_pip_or_copied(void**) {
  run_module("test_package");
}

// Proves PYT-8.

void a_client_that_is_killed_leaves_the_arm_at_rest_and_free(void**) {
  run_module("test_killed");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_client_sends_and_understands_what_the_protocol_says),
      cmocka_unit_test(trajectories_are_sent_as_the_protocol_says),
      cmocka_unit_test(streams_are_sent_as_the_protocol_says),
      cmocka_unit_test(a_server_that_does_not_keep_to_the_protocol_is_named_in_time),
      cmocka_unit_test(the_clock_of_the_server_is_followed),
      cmocka_unit_test(a_simulated_robot_is_moved_in_all_ways),
      cmocka_unit_test(a_server_is_started_with_a_key_and_in_virtual_time),
      cmocka_unit_test(parameters_change_while_the_arm_moves),
      cmocka_unit_test(every_example_runs),
      cmocka_unit_test(the_package_is_installed_by_pip_or_copied),
      cmocka_unit_test(a_client_that_is_killed_leaves_the_arm_at_rest_and_free),
  };
  return run_program_tests(argv[0], tests);
}
