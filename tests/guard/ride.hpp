// Random motions of the arm for tests of the collision check.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/guard/collision_bench.hpp"
#include "tests/support/model_cases.hpp"

namespace tactus {

/// A motion with accelerations at the limits, reversed at random, from a random state of rest.
struct Ride {
  RandomStates states;
  double scale = 1.0;  // of speed and acceleration
  JointVector q, dq, ddq;

  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(states.random); }
  void begin() {
    states.next();
    q = states.q;
    dq.setZero();
    ddq.setZero();
    scale = std::pow(10.0, std::min(0.0, 2.0 * unit()));
  }
  void advance(const JointLimits& limits) {
    constexpr double kDt = CollisionBench::kPeriod_s;
    for (int i = 0; i < kDof; ++i) {
      if (unit() > 0.98) ddq[i] = std::copysign(scale * limits.ddq_max[i], unit());
      const double fastest = scale * limits.dq_max[i];
      if (q[i] > limits.q_max[i] || dq[i] > fastest) ddq[i] = -scale * limits.ddq_max[i];
      if (q[i] < limits.q_min[i] || dq[i] < -fastest) ddq[i] = scale * limits.ddq_max[i];
    }
    q += kDt * dq + 0.5 * kDt * kDt * ddq;
    dq += kDt * ddq;
  }
};

}  // namespace tactus
