// The drives' own loops: CSP and CSV on the simulated arm.
#include "tests/sim_plant/drives/drives_motion.hpp"

namespace tactus::drives {
namespace {

/// CSP with controlword and position in one command PDO.
struct Positioning {
  DrivesBench& bench;
  std::array<std::int32_t, kDof> target{};

  explicit Positioning(DrivesBench& with) : bench(with) {
    bench.boot();
    for (unsigned n = 1; n <= kDof; ++n) {
      const int node = static_cast<int>(n);
      bench.put(node, 0x6060, 0, 8, 1);
      bench.map(node, 0x1400, 0x200 + n, 1, {0x60400010, 0x607A0020});
      bench.map(node, 0x1800, 0x180 + n, 1, {0x60410010, 0x60640020, 0x60770010});
      target[n - 1] = static_cast<std::int32_t>(bench.get(node, 0x6064, 0));
    }
    bench.send(0x000, {0x01, 0x00});
  }
  void cycle(unsigned word) {
    for (unsigned i = 0; i < kDof; ++i) {
      const auto t = static_cast<std::uint32_t>(target[i]);
      bench.send(0x201 + i, {word, 0, t & 0xFF, t >> 8 & 0xFF, t >> 16 & 0xFF, t >> 24});
    }
    bench.now_ns += 1'000'000;
    bench.sync();
    bench.arm.advance(bench.now_ns);
    while (bench.take()) bench.note_feedback();
  }
  void enable() {
    for (const unsigned word : {6U, 7U, 15U}) cycle(word);
    for (int i = 0; i < 200; ++i) cycle(15);
  }
};

// Proves DRV-5.
void positions_are_held_when_the_brakes_open_and_followed_afterwards(void**) {
  Positioning csp(fresh());
  const JointVector q = csp.bench.arm.arm().q();
  csp.enable();
  assert_true(all_are(csp.bench, 0xFFFF, 0x1237));
  ASSERT_NEAR(farthest(csp.bench, q), 0.0, 2e-4);
  for (int k = 1; k <= 1000; ++k) {  // 0.2 rad/s on every joint
    for (std::int32_t& target : csp.target) target += 534;
    csp.cycle(15);
  }
  for (int i = 0; i < kDof; ++i)
    ASSERT_NEAR(csp.bench.arm.arm().q()[i], csp.target[static_cast<std::size_t>(i)] * kIncrement,
                0.003);
  for (int k = 0; k < 1000; ++k) csp.cycle(15);
  for (int i = 0; i < kDof; ++i)
    ASSERT_NEAR(csp.bench.arm.arm().q()[i], csp.target[static_cast<std::size_t>(i)] * kIncrement,
                1e-4);
}

void a_target_that_jumps_is_a_following_error(void**) {
  Positioning csp(fresh());
  csp.enable();
  csp.target[0] += 534000 + 1000;  // beyond the window of 6065h
  csp.cycle(15);
  csp.cycle(15);
  for (int i = 0; i < 1000 && (csp.bench.feedback[0].status & 0x4F) != 0x08; ++i) csp.cycle(15);
  assert_int_equal(csp.bench.get(1, 0x603F, 0), 0x8611);
  assert_int_equal(csp.bench.get(2, 0x603F, 0), 0);
}

void velocities_are_followed_with_their_offset(void**) {
  DrivesBench& bench = fresh();
  bench.configure(9);
  bench.enable();
  bench.cycles(200);
  bench.put(1, 0x60FF, 0, 200000, 4);
  bench.put(1, 0x60B1, 0, 67000, 4);  // 0.1 rad/s in all
  bench.cycles(500);
  ASSERT_NEAR(bench.arm.arm().dq()[0], 267000 * kIncrement, 2e-3);
  ASSERT_NEAR(bench.arm.arm().dq()[3], 0.0, 2e-3);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(positions_are_held_when_the_brakes_open_and_followed_afterwards),
      cmocka_unit_test(a_target_that_jumps_is_a_following_error),
      cmocka_unit_test(velocities_are_followed_with_their_offset),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
