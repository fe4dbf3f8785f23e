// Tests the Python client's class Robot, its example for a FER, and the robot of LeRobot from its
// wheel, by modules in tests/gateway/python.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves PYT-15.

void a_policy_observes_and_acts(void**) {
  assert_succeeds(
      "PYTHONPATH=$R/build/python:$R/gateway/python/examples:$R/tests/gateway/python "
      "/usr/bin/python3 -m unittest test_policy");
}

// Proves PYT-17, PYT-18.

void lerobot_finds_the_arm_and_its_policies_go_on_from_what_it_does(void**) {
  assert_succeeds(
      "PYTHONPATH=$R/build/python:$R/tests/gateway/python:$(echo $R/build/wheel/lerobot_*.whl) "
      "/usr/bin/python3 -m unittest test_lerobot");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_policy_observes_and_acts),
      cmocka_unit_test(lerobot_finds_the_arm_and_its_policies_go_on_from_what_it_does),
  };
  return run_program_tests(argv[0], tests);
}
