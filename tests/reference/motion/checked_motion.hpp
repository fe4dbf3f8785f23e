// CheckedMotion: a bench whose every cycle is checked by the oracle, and motions to begin with.
#pragma once

#include "tests/reference/motion/motion_bench.hpp"
#include "tests/reference/motion/motion_oracle.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/time_optimum.hpp"

namespace tactus {

inline constexpr Fields kQuintics = kVelocityField | kAccelerationField, kCubics = kVelocityField;

template <class Space>
struct CheckedMotion : MotionBench<Space> {
  using Point = typename Space::Point;
  MotionOracle<Space> oracle;

  explicit CheckedMotion(double period = 1e-3, OnlineMode online = OnlineMode::kLimit,
                         Smoothness smoothness = Smoothness::kAcceleration)
      : MotionBench<Space>(period, online), smoothness_(smoothness) {
    oracle.begin(this->channel.settings.limits, period, smoothness, kRateJerk);
  }
  /// Reduces the speed limits to this share from now on.
  void set_speed(double share) {
    typename Space::Limits& limits = this->channel.settings.limits;
    if constexpr (std::is_same_v<Space, JointSpace>) {
      limits.dq_max *= share;
    } else {
      limits.v_max *= share;
      limits.w_max *= share;
    }
    oracle.begin(limits, this->period_s, smoothness_, kRateJerk);
  }
  /// Steps one cycle of a robot that is at `measured`, and checks it.
  void cycle(const Point& measured) {
    ASSERT_OK(this->step(measured));
    const Excess excess = oracle.check(this->out());
    if (excess.what != nullptr)
      print_error("%.4f s, track %d: %s: %.17g, limit %.17g\n", this->generator.time_s(),
                  excess.track, excess.what, excess.value, excess.limit);
    assert_null(excess.what);
  }
  void cycle() { cycle(this->out()); }
  void run(double time_s) {
    for (int k = this->cycles(time_s); k > 0; --k) cycle();
  }
  /// Runs until the reference is at rest, `most_s` at most; returns the seconds it took.
  double stop(double most_s) {
    const double begun_s = this->generator.time_s();
    while (!this->out().standing() && this->generator.time_s() - begun_s < most_s) cycle();
    return this->generator.time_s() - begun_s;
  }

 private:
  Smoothness smoothness_;
};

using CheckedJoints = CheckedMotion<JointSpace>;
using CheckedTip = CheckedMotion<TaskSpace>;

inline SymmetricLimits axis_limits(int joint) {
  const JointLimits limits;
  return {limits.dq_max[joint], limits.ddq_max[joint], limits.dddq_max[joint]};
}

/// Sends a motion that goes from rest to `dq` within 0.4 s, keeps it for `cruise_s`, and comes to
/// rest; the middle of its way is `middle`. Returns after 0.5 s, at constant velocity.
inline std::uint32_t cruise(CheckedJoints& bench, const JointVector& middle, const JointVector& dq,
                            double cruise_s = 1.0) {
  constexpr double kRun_s = 0.4;
  JointSpace::Point point;
  point.q = middle - 0.5 * (kRun_s + cruise_s) * dq;
  ASSERT_OK(bench.start(point));
  bench.oracle.forget();
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintics);
  bench.add(*motion, 0.0, point);
  point.q += 0.5 * kRun_s * dq;
  point.dq = dq;
  bench.add(*motion, kRun_s, point);
  point.q += cruise_s * dq;
  bench.add(*motion, kRun_s + cruise_s, point);
  point.q += 0.5 * kRun_s * dq;
  point.dq.setZero();
  bench.add(*motion, 2.0 * kRun_s + cruise_s, point);
  const std::uint32_t id = bench.send(*motion);
  assert_int_not_equal(id, 0);
  bench.run(kRun_s + 0.1);
  ASSERT_NEAR((bench.out().dq - dq).norm(), 0.0, 1e-9);
  return id;
}

/// Returns the velocity dq of one joint, with all others at zero.
inline JointVector only(int joint, double dq) {
  JointVector all = JointVector::Zero();
  all[joint] = dq;
  return all;
}

}  // namespace tactus
