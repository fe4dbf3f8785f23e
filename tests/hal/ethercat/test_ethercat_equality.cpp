// A motion over the segment, and the same with the linked-in robot.
#include "tests/hal/cia402/equality.hpp"
#include "tests/hal/ethercat/master_bench.hpp"

namespace tactus::ethercat {
namespace {

// Proves ECAT-7.
void the_segment_changes_a_motion_by_no_more_than_it_rounds(void**) {
  static MasterBench bench;
  ASSERT_OK(bench.load());
  cia402::compare_with_the_linked_in_robot(bench);
  const LineCounts& counts = bench.hal.master.counts();
  assert_true(counts.frames > cia402::kRows);
  assert_int_equal(counts.lost + counts.late + counts.counter + counts.strange, 0);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_segment_changes_a_motion_by_no_more_than_it_rounds),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
