// The master against the emulated drives: armed, commanded and stopped through an executive.
#include "tests/drives/master_bench.hpp"

namespace tactus::can {
namespace {

MasterBench& fresh() {
  static MasterBench* bench = nullptr;
  delete bench;
  return *(bench = new MasterBench);
}

void explain(MasterBench& bench, Status status) {
  if (status != Status::kOk)
    print_error("%s: %s\n", name(status), bench.hal.master.trouble().c_str());
}

// Proves CAN-10.
void the_arm_is_taken_over_and_held_where_it_stands(void**) {
  MasterBench& bench = fresh();
  ASSERT_OK(bench.load());
  const JointVector before = bench.hal.arm.arm().q();
  const Status status = bench.start();
  explain(bench, status);
  ASSERT_OK(status);
  ASSERT_OK(bench.cycles(500));
  const JointVector moved = bench.hal.arm.arm().q() - before;
  for (int j = 0; j < kDof; ++j) ASSERT_NEAR(moved[j], 0.0, 1e-3);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_arm_is_taken_over_and_held_where_it_stands),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
