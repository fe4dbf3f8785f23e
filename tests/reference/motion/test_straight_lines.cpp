// Paths of straight lines under any request at any time: the position never steps, the velocity
// only where lines meet.
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr double kPeriod_s = ReferenceBench::kPeriod_s;

/// The corners of all trajectories sent: joint 0's offsets from home.
struct Corners {
  std::array<double, 4096> offsets{};
  int count = 0;
  void add(double offset) { offsets[static_cast<std::size_t>(count++)] = offset; }
  /// True if there is a corner between a and b, or no more than `margin` beyond.
  bool between(double a, double b, double margin) const {
    for (int i = 0; i < count; ++i) {
      const double corner = offsets[static_cast<std::size_t>(i)];
      if (corner >= std::min(a, b) - margin && corner <= std::max(a, b) + margin) return true;
    }
    return false;
  }
};

void send_lines(ReferenceBench& bench, Random& random, Corners& corners) {
  Trajectory<JointSpace>* lines = bench.trajectory(0);
  if (lines == nullptr) return;
  double time_s = 0.0;
  std::array<double, 4> offsets{};
  for (double& offset : offsets) {
    time_s += random.uniform(0.8, 2.0);
    offset = random.uniform(-0.2, 0.2);
    bench.add(*lines, time_s, offset);
  }
  std::uint32_t id = 0;
  if (!bench.client.send(*lines, id).ok()) return;
  for (const double offset : offsets) corners.add(offset);
}

void ask(ReferenceBench& bench, Random& random, Corners& corners) {
  std::uint32_t id = 0;
  switch (random.below(8)) {
    case 0: return static_cast<void>(bench.client.cancel(id));
    case 1: return static_cast<void>(bench.client.set_override(random.uniform(0.0, 1.0), id));
    case 2: return static_cast<void>(bench.client.pause(id));
    case 3:
    case 4: return static_cast<void>(bench.client.resume(id));
    default: return send_lines(bench, random, corners);
  }
}

// Proves RG-11.

void the_position_never_steps_and_the_velocity_only_at_waypoints(void**) {
  static ReferenceBench bench;
  static Corners corners;
  Random random{31};
  const JointLimits& limits = bench.channel.settings.limits;
  int steps = 0;
  bool beginning = false;
  for (int request = 0; request < 2000; ++request) {
    ask(bench, random, corners);
    const int cycles = 1 + random.below(800);
    for (int k = 0; k < cycles; ++k) {
      const JointSpace::Point before = bench.out();
      ASSERT_OK(bench.step());
      const JointSpace::Point& now = bench.out();
      const double moved = std::abs(now.q[0] - before.q[0]), dq = now.dq[0] - before.dq[0];
      const double fastest = std::max(std::abs(now.dq[0]), std::abs(before.dq[0]));
      assert_true(moved <= fastest * kPeriod_s + 4e-6);  // a dt^2 / 4 between two samples
      const double from = before.q[0] - bench.home[0], to = now.q[0] - bench.home[0];
      const bool stepped = std::abs(dq) > limits.ddq_max[0] * kPeriod_s * (1.0 + 1e-9);
      assert_true(!stepped || beginning || corners.between(from, to, fastest * kPeriod_s + 1e-9));
      assert_true(std::abs(dq) <= limits.velocity_step[0] + limits.ddq_max[0] * kPeriod_s);
      steps += stepped;
      Report report;  // the first line begins in the cycle after its trajectory is taken
      beginning = false;
      while (bench.client.poll(report)) beginning |= report.outcome == Outcome::kStarted;
    }
  }
  assert_true(steps > 100 && corners.count < 4096);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_position_never_steps_and_the_velocity_only_at_waypoints),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
