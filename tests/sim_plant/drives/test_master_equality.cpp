// A motion over the bus, with CAN FD, and the same with the linked-in robot.
#include "tests/hal/cia402/equality.hpp"
#include "tests/sim_plant/drives/master_bench.hpp"

namespace tactus::can {
namespace {

// Proves CAN-14.
void the_bus_changes_a_motion_by_no_more_than_it_rounds(void**) {
  static MasterBench bench;
  ASSERT_OK(bench.load());
  cia402::compare_with_the_linked_in_robot(bench);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_bus_changes_a_motion_by_no_more_than_it_rounds),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
