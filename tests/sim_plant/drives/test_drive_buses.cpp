// One arm on several buses, and on none that has a SYNC.
#include "tests/sim_plant/drives/drives_motion.hpp"

namespace tactus::drives {
namespace {

// Proves DRV-3.
void three_buses_move_the_arm_as_one_does(void**) {
  static std::array<Feedback, kDof> single;
  for (const bool three : {false, true}) {
    DrivesBench& bench = fresh(three ? three_buses() : one_bus());
    bench.configure(10);
    hold_gravity(bench);
    const JointVector g = bench.arm.arm().gravity();
    bench.enable();
    for (int k = 0; k < 400; ++k) {
      swing(bench, g, k);
      bench.cycle();
    }
    if (!three) single = bench.feedback;
    for (std::size_t i = 0; i < kDof && three; ++i) {
      assert_int_equal(bench.feedback[i].position, single[i].position);
      assert_int_equal(bench.feedback[i].torque, single[i].torque);
    }
  }
}

void a_bus_without_sync_delays_no_other(void**) {
  DrivesBench& bench = fresh(three_buses());
  bench.configure(10);
  hold_gravity(bench);
  bench.enable();
  bench.cycles(10);
  const std::int64_t periods = bench.arm.periods();
  for (int i = 0; i < 50; ++i) {
    bench.send_commands();
    bench.now_ns += 1'000'000;
    bench.send(0x080, {}, 0);
    bench.send(0x080, {}, 2);
    bench.expect_nothing(0x184);
  }
  assert_int_equal(bench.arm.periods() - periods, 50);
}

void without_a_master_the_arm_follows_the_clock(void**) {
  DrivesBench& bench = fresh();
  bench.configure(10);
  for (int n = 1; n <= kDof; ++n) {
    bench.put(n, 0x1016, 1, 0x007F001E, 4);
    bench.put(n, 0x1029, 1, 1, 1);
    bench.put(n, 0x6007, 0, 3, 2);
  }
  bench.send(0x77F, {0x05});
  hold_gravity(bench);
  bench.enable();
  for (int i = 0; i < 20; ++i) {
    bench.send(0x77F, {0x05});
    bench.cycles(10);
  }
  bench.torque.fill(0);
  bench.cycles(20);
  bench.run_ms(500);
  for (int i = 0; i < kDof; ++i)
    assert_int_equal(bench.arm.node(i).axis().statusword() & 0x4F, 0x40);
  ASSERT_NEAR(bench.arm.arm().dq().norm(), 0.0, 1e-9);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(three_buses_move_the_arm_as_one_does),
      cmocka_unit_test(a_bus_without_sync_delays_no_other),
      cmocka_unit_test(without_a_master_the_arm_follows_the_clock),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
