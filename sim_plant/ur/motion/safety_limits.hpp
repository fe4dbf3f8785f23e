// Why a CB3 stops: its codes, and the limits that its safety system checks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim_plant/ur/motion/kinematics.hpp"

namespace tactus::ur {

/// The codes with which a CB3 reports why it stopped: code and argument, as in its error message
/// "C153A2". Universal Robots, "Error codes", CB3.
enum class Code : std::int32_t {
  kNone = 0,
  kCloseToJointLimit = 150,
  kPathDeviation = 153,  ///< argument: joint
  kSingularity = 154,
  kCollision = 157,  ///< argument: joint
  kBlend = 171,
  kTorqueTooHigh = 173,    ///< argument: joint
  kSafetyViolation = 191,  ///< argument: the violated limit
  kPathSanity = 204,       ///< argument: see the next enumeration
  kFieldbusDisconnected = 207,
  kFromScript = 209,
};

enum PathSanity : std::int32_t {
  kSuddenChange = 1,
  kInconsistent = 2,
  kSuddenStop = 3,
  kNotStopped = 4,
  kInvalidSetPoint = 5,
};

enum BlendTrouble : std::int32_t { kOverlappingBlends = 1 };

enum SafetyViolation : std::int32_t {
  kViolatedJointPosition = 1,
  kViolatedJointSpeed = 2,
  kViolatedTcpSpeed = 3,
  kViolatedMomentum = 12,
};

struct Stop {
  Code code = Code::kNone;
  std::int32_t argument = 0;

  explicit operator bool() const { return code != Code::kNone; }
};

/// SafetyLimits: the limits that the safety system checks independently of the controller, which
/// stays below them. A limit exceeded for longer than the detection time is a violation. Limits,
/// accuracies and times: UR10 user manual (CB3), safety-related functions, default settings.
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
