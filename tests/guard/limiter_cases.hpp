// Shared by the tests of the position and velocity limiters: the FER's first joint, sequences that
// would break every limit, and a watch that computes the limited quantities from the sent sequence.
#pragma once

#include <algorithm>
#include <random>

#include "kernel/guard/step_band.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr double kLimitPeriods_s[] = {8e-3, 1e-3, 1e-4};

/// Judges a sequence of positions from outside; it computes the differences itself.
class Watch {
 public:
  Watch(const JointLimits& limits, int joint, double period_s, double q, double dq)
      : limits_(limits), joint_(joint), dt_(period_s), q_(q), dq_(dq) {}

  /// Asserts that the next position keeps every limit, allowances included.
  void sees(double q) {
    const double dq = (q - q_) / dt_, ddq = (dq - dq_) / dt_;
    assert_true(q >= limits_.q_min[joint_] - kPositionAllowance - 1e-12);
    assert_true(q <= limits_.q_max[joint_] + kPositionAllowance + 1e-12);
    assert_true(std::abs(dq) <= limits_.dq_max[joint_] + (kStepAllowance + kRounding) / dt_);
    assert_true(std::abs(ddq) <=
                limits_.ddq_max[joint_] + (kChangeAllowance + kRounding) / (dt_ * dt_));
    q_ = q;
    dq_ = dq;
  }

 private:
  static constexpr double kRounding = 2e-15;  // rad, of the differences computed here
  JointLimits limits_;
  int joint_;
  double dt_, q_, dq_;
};

/// Hostile sequences of commands, in -1..1 or far beyond. `at` is the position of the robot, -1..1.
inline constexpr int kHostileKinds = 7;
inline double hostile(int kind, int cycle, double at, std::mt19937_64& bits) {
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  switch (kind) {
    case 0: return any(bits);                            // white noise
    case 1: return cycle % 1000 < 500 ? 1e300 : -1e300;  // to one end, then to the other
    case 2:
      return at > 0.97 ? -1e9 : cycle % 3000 < 2000 ? 1e9 : 0.0;  // reverses at the last moment
    case 3: return cycle % 2 == 0 ? 1e6 : -1e6;                   // from end to end in every cycle
    case 4: return std::sin(1e-6 * cycle * cycle) * 1.2;          // ever faster
    case 5: return at + 1e-4 * any(bits);                         // trembles in place
    default: return cycle % 700 == 0 ? 1.5 : at + 0.01 * any(bits);
  }
}

/// A first command beyond `change` is jerky: 7500 rad/s^3 are 7.5 rad/s^2 in a cycle.
template <class Bench>
void assert_jerky_from(double change) {
  Bench b;
  b.next(0.9 * change);
  assert_false(b.limiter.jerky());
  b = Bench();
  b.next(1.1 * change);
  assert_true(b.limiter.jerky());
}

}  // namespace tactus
