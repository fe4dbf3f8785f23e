// Tests what becomes of recorded angles of joints without end, by a module in tests/gateway/python:
// in files that are checked and run, from tactusctl and from the Python client.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves CSV-9, CSV-10, IMP-3, CTL-18.

void recorded_angles_are_taken_as_it_is_asked_for(void**) {
  assert_succeeds(
      "PYTHONPATH=$R/build/python:$R/tests/gateway/python /usr/bin/python3 -m unittest test_turns");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(recorded_angles_are_taken_as_it_is_asked_for),
  };
  return run_program_tests(argv[0], tests);
}
