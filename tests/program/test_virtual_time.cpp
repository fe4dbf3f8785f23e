// Tests that only a simulated robot is served in virtual time.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves GW-16.

void a_real_robot_has_no_virtual_time_and_a_simulated_one_has(void**) {
  assert_int_equal(tactus_run({"ports"}), 0);
  const bool simulated = output().find("## [plant]") != std::string_view::npos;
  assert_int_equal(tactus_run({"serve", in_folder("none.ini").c_str(), "--virtual-time"}), 2);
  assert_true(has(errors(), simulated ? "none.ini" : "has no virtual time; leave it out"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_real_robot_has_no_virtual_time_and_a_simulated_one_has),
  };
  return run_program_tests(argv[0], tests);
}
