// SafetyLimits: the limits that the safety system checks independently of the controller, which
// stays below them. A limit exceeded for longer than the detection time is a violation. Limits,
// accuracies and times: UR10 user manual (CB3), safety-related functions, default settings.
#pragma once

#include <algorithm>
#include <array>

#include "sim_plant/ur/motion/kinematics.hpp"
#include "sim_plant/ur/motion/safety_codes.hpp"

namespace tactus::ur {

struct SafetyLimits {
  Joints speed;                       ///< rad/s
  double position = 363.0 * kDegree;  ///< rad
  double tcp_speed = 1.5;             ///< m/s
  double momentum = 25.0;             ///< kg m/s

  SafetyLimits() {
    speed << 131.46, 131.46, 191.46, 191.46, 191.46, 191.46;
    speed *= kDegree;
  }
};

class LimitWatch {
 public:
  explicit LimitWatch(const SafetyLimits& limits) : limits_(limits) {}

  /// Checks one cycle of `h_s` in this state. Returns 0 or the argument of C191. NaN is a
  /// violation. [cyclic]
  std::int32_t check(const Joints& q, const Joints& dq, double tcp_speed, double momentum,
                     double h_s) {
    const bool within[] = {q.cwiseAbs().maxCoeff() <= limits_.position + 1.15 * kDegree,
                           (dq.cwiseAbs().array() <= limits_.speed.array() + 1.15 * kDegree).all(),
                           tcp_speed <= limits_.tcp_speed + 0.05,
                           momentum <= limits_.momentum + 3.0};
    constexpr double kDetection_s[] = {0.1, 0.25, 0.25, 0.25};
    constexpr std::int32_t kArgument[] = {kViolatedJointPosition, kViolatedJointSpeed,
                                          kViolatedTcpSpeed, kViolatedMomentum};
    for (std::size_t i = 0; i < over_s_.size(); ++i) {
      over_s_[i] = within[i] ? 0.0 : over_s_[i] + h_s;
      if (over_s_[i] > kDetection_s[i]) return kArgument[i];
    }
    return 0;
  }
  const SafetyLimits& limits() const { return limits_; }

 private:
  SafetyLimits limits_;
  std::array<double, 4> over_s_{};
};

}  // namespace tactus::ur
