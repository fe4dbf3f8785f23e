// HermiteOracle: the motion between waypoints computed a second time, from a table of the Hermite
// forms and at many samples. It shares no line with kernel/reference/space/polynomial.cpp, which
// admission uses.
#pragma once

#include <algorithm>
#include <cmath>

#include "kernel/reference/motion/trajectory.hpp"
#include "kernel/reference/space/joint_space.hpp"

namespace tactus {

/// Position, velocity, acceleration and jerk, by the number of the derivative.
inline constexpr int kDerivatives = 4;

struct Range1 {
  double min = kInfinity, max = -kInfinity;
  void add(double value) {
    min = std::fmin(min, value);
    max = std::fmax(max, value);
  }
};
using Ranges = std::array<Range1, kDerivatives>;

class HermiteOracle {
 public:
  static constexpr int kSamples = 2000;

  HermiteOracle() {
    for (std::size_t order = 0; order < kForms.size(); ++order) {
      for (int i = 0; i <= kSamples; ++i) {
        for (int k = 0; k < kDerivatives; ++k) weigh(order, i, k);
      }
    }
  }

  /// Returns the ranges of one joint on the segment that ends at `waypoint`, over every `stride`-th
  /// sample.
  Ranges ranges(const Trajectory<JointSpace>& motion, int waypoint, int joint, int stride) const {
    const Ends ends(motion, waypoint, joint);
    Ranges ranges;
    for (int i = 0; i <= kSamples; i += stride) {
      for (int k = 0; k < kDerivatives; ++k) ranges[index(k)].add(ends.at(weights_, i, k));
    }
    return ranges;
  }
  /// Returns the velocity of one joint at either end of the segment that ends at `waypoint`.
  double velocity(const Trajectory<JointSpace>& motion, int waypoint, int joint, bool end) const {
    return Ends(motion, waypoint, joint).at(weights_, end ? kSamples : 0, 1);
  }

 private:
  static constexpr int kValues = 6;
  using Form = std::array<std::array<double, 6>, kValues>;
  using Weights =
      std::array<std::array<std::array<std::array<double, kValues>, kDerivatives>, kSamples + 1>,
                 3>;

  static constexpr std::size_t index(int i) { return static_cast<std::size_t>(i); }

  // Coefficients of 1, x .. x^5 with x = t/T, for p0, v0 T, a0 T^2, p1, v1 T and a1 T^2.
  // clang-format off
  static constexpr std::array<Form, 3> kForms = {{
      {{{{1, -1}}, {}, {}, {{0, 1}}, {}, {}}},
      {{{{1, 0, -3, 2}}, {{0, 1, -2, 1}}, {}, {{0, 0, 3, -2}}, {{0, 0, -1, 1}}, {}}},
      {{{{1, 0, 0, -10, 15, -6}}, {{0, 1, 0, -6, 8, -3}}, {{0, 0, 0.5, -1.5, 1.5, -0.5}},
        {{0, 0, 0, 10, -15, 6}}, {{0, 0, 0, -4, 7, -3}}, {{0, 0, 0, 0.5, -1, 0.5}}}},
  }};
  // clang-format on

  void weigh(std::size_t order, int sample, int derivative) {
    const double x = static_cast<double>(sample) / kSamples;
    for (std::size_t m = 0; m < kValues; ++m) {
      double sum = 0.0;
      for (int power = derivative; power <= 5; ++power) {
        double term = kForms[order][m][index(power)] * std::pow(x, power - derivative);
        for (int n = 0; n < derivative; ++n) term *= power - n;
        sum += term;
      }
      weights_[order][index(sample)][index(derivative)][m] = sum;
    }
  }

  /// The values of one joint at both ends of a segment.
  struct Ends {
    Ends(const Trajectory<JointSpace>& motion, int waypoint, int j) {
      const Waypoint<JointSpace>&a = motion.waypoints[waypoint - 1],
            &b = motion.waypoints[waypoint];
      T = b.time_s - a.time_s;
      from = a.point.q[j];
      values = {0.0,
                a.point.dq[j] * T,
                a.point.ddq[j] * T * T,
                b.point.q[j] - from,
                b.point.dq[j] * T,
                b.point.ddq[j] * T * T};
      const bool by_fields = motion.interpolation == Interpolation::kByFields;
      const bool v = motion.fields & kVelocityField, a_too = motion.fields & kAccelerationField;
      order = !by_fields ? static_cast<std::size_t>(motion.interpolation) - 1
              : !v       ? 0
              : a_too    ? 2
                         : 1;
    }
    double at(const Weights& weights, int sample, int derivative) const {
      const auto& weight = weights[order][index(sample)][index(derivative)];
      double sum = 0.0;
      for (std::size_t m = 0; m < kValues; ++m) sum += weight[m] * values[m];
      for (int n = 0; n < derivative; ++n) sum /= T;
      return derivative == 0 ? from + sum : sum;
    }
    double T, from;
    std::array<double, kValues> values;
    std::size_t order;
  };

  Weights weights_;
};

}  // namespace tactus
