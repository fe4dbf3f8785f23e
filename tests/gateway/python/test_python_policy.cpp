// Tests the Python client's class Robot, and its example for a FER, by a module in
// tests/gateway/python.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves PYT-15.

void a_policy_observes_and_acts(void**) {
  assert_succeeds(
      "PYTHONPATH=$R/build/python:$R/gateway/python/examples:$R/tests/gateway/python "
      "/usr/bin/python3 -m unittest test_policy");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {cmocka_unit_test(a_policy_observes_and_acts)};
  return run_program_tests(argv[0], tests);
}
