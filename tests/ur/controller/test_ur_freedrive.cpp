// Tests freedrive of the emulated controller: the arm follows a hand.
#include "tests/ur/programs/ur_program_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

const Joints kStart = ProgramBench::settings().initial_q;

// Proves URE-17.

void in_freedrive_the_arm_yields_and_bears_its_weight(void**) {
  static ProgramBench bench;
  start_and_wait(bench, "  freedrive_mode()\n  sleep(2.0)\n  end_freedrive_mode()\n");
  bench.run(50);
  assert_joints(bench.machine().body.q(), kStart, 1e-6);
  assert_int_equal(bench.image().robot_mode, 7);
  assert_int_equal(bench.image().robot_status_bits & 4u, 4u);
  bench.controller.faults().push = joints({20, 0, 0, 0, 0, 0});
  bench.run(75);
  bench.controller.faults().push.setZero();
  const double pushed = bench.image().actual_q[0] - kStart[0];
  assert_true(pushed > 0.05 && bench.image().actual_qd[0] > 0.05);
  assert_joints(bench.target(), bench.machine().body.q(), 1e-9);
  // The hand lets go while the mode ends: the targets brake from the arm's position.
  bench.controller.faults().push = joints({20, 0, 0, 0, 0, 0});
  Joints before = bench.target(), before_qd = bench.image().target_qd;
  for (int k = 0; k < 200; ++k) {
    if (k == 130) bench.controller.faults().push.setZero();
    bench.tick();
    assert_true((bench.target() - before).cwiseAbs().maxCoeff() < 2.1 * kCycle_s);
    before = bench.target();
    const Joints qd = bench.image().target_qd;
    assert_true((qd - before_qd).cwiseAbs().maxCoeff() < 8.0 * kCycle_s);
    before_qd = qd;
    if (bench.machine().freedrive) assert_joints(qd, bench.image().actual_qd, 1e-9);
  }
  assert_false(bench.machine().freedrive);
  assert_int_equal(bench.image().robot_status_bits & 4u, 0u);
  assert_int_equal(bench.image().safety_mode, 1);
  ASSERT_NEAR(bench.image().target_qd.norm(), 0.0, 1e-9);
  assert_joints(bench.image().actual_q, bench.target(), 1e-3);
}

void freedrive_ends_with_its_program(void**) {
  static ProgramBench bench;
  start_and_wait(bench, "  freedrive_mode()\n");
  bench.run(20);
  assert_true(bench.machine().freedrive);
  bench.upload("movej([0.2, -1.2, 1.2, -0.1, 1.57, 0.0])\n");
  bench.run(2);
  assert_false(bench.machine().freedrive);
  bench.run_to_end();
  ASSERT_NEAR(bench.target()[0], 0.2, 1e-9);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(in_freedrive_the_arm_yields_and_bears_its_weight),
      cmocka_unit_test(freedrive_ends_with_its_program),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
