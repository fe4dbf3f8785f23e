// PathLaw: keeps the limits for any requested rate, and stops nearly as fast as acceleration
// allows. The oracle (path_cases.hpp) differentiates the paths by itself.
#include <vector>

#include "kernel/reference/motion/admission_room.hpp"
#include "kernel/reference/motion/path_law.hpp"
#include "tests/reference/motion/path_cases.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr double kShare = 0.98;

/// The number of paths of each kind to try.
constexpr int kPaths = tries(140, 40);

/// A random path with its law, and the largest use of the limits: of acceleration at the samples
/// and in the mean between them, which for lines would be their steps.
struct Runner {
  double period_s;
  std::array<Waypoint<JointSpace>, RandomPath::kPieces + 1> waypoints;
  Trajectory<JointSpace> trajectory;
  RandomPath own;
  Path<JointSpace> path;
  PathLaw<JointSpace> law;
  JointLimits limits;
  bool lines;
  double v = 0.0, a = 0.0, jerk = 0.0;

  Runner(PathKind kind, Random& random, double period = 1e-3)
      : period_s(period), own(kind, random, kShare), lines(kind == PathKind::kLines) {
    trajectory.waypoints = waypoints.data();
    trajectory.capacity = trajectory.count = RandomPath::kPieces + 1;
    own.fill(trajectory, 0, RandomPath::kPieces);
  }
  /// Opens the path at waypoint `index` and sets the rooms that let it stop there.
  void open_until(int index) {
    trajectory.open = index < RandomPath::kPieces;
    trajectory.count = index + 1;
    const AdmissionSettings<JointSpace> settings;
    trajectory.waypoints[0].room =
        set_rooms(trajectory, settings, 0, 0, index, trajectory.open ? 0.0 : 1.0);
    if (!trajectory.open)
      for (Waypoint<JointSpace>& waypoint : waypoints) waypoint.room = waypoint.halfway = 1.0F;
  }
  void start(double s, double rate) {
    path = Path<JointSpace>(trajectory, {}, JointLimits());
    path.enter(s);
    law.start(path, s, rate, JointSpace::peaks(limits), period_s);
  }
  JointVector acceleration(const PathPlace& p) const {
    return p.d2 * (law.rate() * law.rate()) + p.d1 * law.slope();
  }
  void step(double target) {
    const double s = law.s(), rate = law.rate(), slope = law.slope();
    const PathPlace begin = own.place(s);
    const JointVector before = acceleration(begin);
    law.step(path, target, JointSpace::peaks(limits), period_s);
    const JointSpace::Point out = path.at(law.s());
    const PathPlace now = own.place(law.s());
    const JointVector after = acceleration(now);
    assert_true(law.rate() >= 0.0 && law.rate() <= 1.0 && law.s() >= s);
    JointVector steps = JointVector::Zero();  // of the path itself
    for (int k = 1; k < RandomPath::kPieces; ++k) {
      const double knot = own.time_s(k);
      if (knot <= s + 1e-9 || knot > law.s() + 1e-9) continue;
      const PathPlace first = own.on_piece(k - 1, knot), next = own.on_piece(k, knot);
      steps += (next.d2 - first.d2) * (rate * rate) + (next.d1 - first.d1) * slope;
    }
    for (int j = 0; j < kDof; ++j) {
      ASSERT_NEAR(out.q[j], now.q[j], 1e-8);
      v = std::fmax(v, std::fabs(now.d1[j] * law.rate()) / limits.dq_max[j]);
      a = std::fmax(a, std::fabs(after[j]) / limits.ddq_max[j]);
      const double dv = lines ? 0.0 : now.d1[j] * law.rate() - begin.d1[j] * rate;
      a = std::fmax(a, std::fabs(dv) / (period_s * limits.ddq_max[j]));
      jerk = std::fmax(
          jerk, std::fabs(after[j] - before[j] - steps[j]) / (period_s * limits.dddq_max[j]));
    }
  }
};

double percentile(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty()
             ? 0.0
             : values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void stops_of(PathKind kind) {
  Random random{20261122 + static_cast<std::uint64_t>(kind)};
  std::vector<double> ratios, jerks, times;
  double v = 0.0, a = 0.0;
  int never = 0;
  for (int n = trials(kPaths); n > 0; --n) {
    Runner runner(kind, random);
    const double begin = random.uniform(0.02, 0.7) * runner.own.end_s();
    runner.start(begin, 1.0);
    int cycles = 0;
    const double end = runner.own.end_s();
    for (; !runner.law.standing() && runner.law.s() < end && cycles < 20000; ++cycles)
      runner.step(0.0);
    const double quickest = runner.own.quickest_stop_s(begin);
    if (!runner.law.standing())
      ++never;
    else if (quickest > 0.02 && quickest < kInfinity) {
      ratios.push_back(cycles * runner.period_s / quickest);
      times.push_back(quickest);
    }
    v = std::fmax(v, runner.v);
    a = std::fmax(a, runner.a);
    jerks.push_back(runner.jerk);
  }
  print_message(
      "  %-22s optimum %3.0f/%3.0f ms, ratio %.3f/%.3f/%.3f/%.2f, a %.10f, v %.6f, jerk "
      "%.3f/%.3f/%.3f, never %d\n",
      kPathKindNames[static_cast<std::size_t>(kind)], 1e3 * percentile(times, 0.5),
      1e3 * percentile(times, 0.9), percentile(ratios, 0.5), percentile(ratios, 0.9),
      percentile(ratios, 0.99), percentile(ratios, 1.0), a, v, percentile(jerks, 0.5),
      percentile(jerks, 0.99), percentile(jerks, 1.0), never);
  assert_true(v <= 1.0 + 1e-9);
  assert_true(a <= 1.0 + 1e-9);
  // Where the acceleration of the path steps, the slope must fit at the step: acceleration goes
  // before jerk.
  if (kind == PathKind::kConstantAcceleration) {
    assert_true(percentile(jerks, 0.99) <= 1.15);
  } else {
    assert_true(percentile(jerks, 1.0) <= 1.02);
  }
  // The optimum has no jerk limit; a low one costs the time to build up the acceleration.
  const JointLimits limits;
  const bool quick = limits.ddq_max[0] <= 2.1e-3 * limits.dddq_max[0];
  assert_true(percentile(ratios, 0.5) <= (quick ? 1.1 : 1.2));
  assert_true(percentile(ratios, 0.99) <= (quick ? 1.3 : 1.5));
  assert_int_equal(never, 0);
}

// Proves RG-11.

void a_stop_keeps_limits_and_is_nearly_as_quick_as_acceleration_allows(void**) {
  for (const PathKind kind : kPathKinds) stops_of(kind);
}

/// The targets are 0, 1 or any rate, changed every 1..30 or 30..500 ms.
void change_rates(Runner& runner, Random& random) {
  runner.start(0.0, 1.0);
  double target = 1.0, left_s = 0.0;
  for (int k = 0; k < 20000 && runner.law.s() < runner.own.end_s(); ++k) {
    left_s -= runner.period_s;
    if (left_s < 0.0) {
      const int which = random.below(4);
      target = which == 0 ? 0.0 : which == 1 ? 1.0 : random.uniform(0.0, 1.0);
      left_s = random.below(2) != 0 ? random.uniform(0.0, 0.03) : random.uniform(0.03, 0.5);
    }
    runner.step(target);
  }
}

void a_path_keeps_limits_whatever_rate_is_asked_for_and_when(void**) {
  for (const double period_s : {1e-3, 2e-3, 8e-3}) {
    for (const PathKind kind : kPathKinds) {
      Random random{7 + static_cast<std::uint64_t>(kind)};
      double v = 0.0, a = 0.0, jerk = 0.0;
      for (int n = trials(kPaths) / 12 + 1; n > 0; --n) {
        Runner runner(kind, random, period_s);
        change_rates(runner, random);
        v = std::fmax(v, runner.v);
        a = std::fmax(a, runner.a);
        jerk = std::fmax(jerk, runner.jerk);
      }
      print_message("  %-22s %g ms: a %.10f, v %.6f, jerk %.3f\n",
                    kPathKindNames[static_cast<std::size_t>(kind)], 1e3 * period_s, a, v, jerk);
      assert_true(v <= 1.0 + 1e-9);
      assert_true(a <= 1.0 + 1e-9);
      const bool smooth = kind == PathKind::kSmooth || kind == PathKind::kWild;
      assert_true(!smooth || jerk <= 1.001);
    }
  }
}

// Proves RG-14.

void an_open_path_is_never_run_to_its_end(void**) {
  for (const PathKind kind : kPathKinds) {
    Random random{99 + static_cast<std::uint64_t>(kind)};
    double v = 0.0, a = 0.0, least_s = kInfinity, rates = 0.0, jerk = 0.0;
    int cycles = 0;
    for (int n = trials(kPaths) / 4; n > 0; --n) {
      Runner runner(kind, random);
      int known = 1 + random.below(3);
      const bool cut_off = random.below(10) < 3, targets = random.below(2) != 0;
      const int cut = cut_off ? RandomPath::kPieces / 2 : RandomPath::kPieces;
      runner.open_until(known);
      runner.start(0.0, 1.0);
      const double ahead_s = random.uniform(0.02, 0.3);
      double target = 1.0;
      for (int k = 0; k < 60000 && runner.law.s() < runner.own.end_s(); ++k) {
        if (targets && random.below(100) == 0)
          target = random.below(2) != 0 ? 1.0 : random.uniform(0.3, 1.0);
        if (known < cut && runner.own.time_s(known) - runner.law.s() < ahead_s) {
          known = std::min(cut, known + 1 + random.below(2));
          runner.open_until(known);
        }
        if (cut_off && known == cut && runner.law.standing()) break;
        runner.step(target);
        rates += runner.law.rate();
        ++cycles;
        if (runner.trajectory.open) {
          least_s = std::fmin(least_s, runner.path.end_s() - runner.law.s());
        }
      }
      if (cut_off) assert_true(runner.law.standing());
      v = std::fmax(v, runner.v);
      a = std::fmax(a, runner.a);
      jerk = std::fmax(jerk, runner.jerk);
    }
    print_message("  %-22s a %.10f, v %.6f, jerk %.3f, least way left %.3f ms, mean rate %.2f\n",
                  kPathKindNames[static_cast<std::size_t>(kind)], a, v, jerk, 1e3 * least_s,
                  rates / cycles);
    assert_true(v <= 1.0 + 1e-9);
    assert_true(a <= 1.0 + 1e-9);
    assert_true(least_s > 0.0);
  }
}

/// Where room is short only at a waypoint the rate falls to what that leaves, and no lower.
void a_rate_falls_no_lower_than_the_least_room_ahead(void**) {
  Random random{5};
  for (int n = 20; n > 0; --n) {
    Runner runner(PathKind::kSmooth, random);
    runner.open_until(RandomPath::kPieces - 1);
    for (Waypoint<JointSpace>& waypoint : runner.waypoints) waypoint.room = waypoint.halfway = 1.0F;
    runner.waypoints[2].room = 0.25F;
    runner.start(0.0, 1.0);
    double lowest = 1.0;
    for (int k = 0; k < 20000 && runner.law.s() < runner.own.time_s(3); ++k) {
      runner.step(1.0);
      lowest = std::fmin(lowest, runner.law.rate());
    }
    assert_true(lowest > 0.5 - 1e-3);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_stop_keeps_limits_and_is_nearly_as_quick_as_acceleration_allows),
      cmocka_unit_test(a_path_keeps_limits_whatever_rate_is_asked_for_and_when),
      cmocka_unit_test(an_open_path_is_never_run_to_its_end),
      cmocka_unit_test(a_rate_falls_no_lower_than_the_least_room_ahead),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
