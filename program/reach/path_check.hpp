// PathCheck: whether the arm can follow a path of its tip. It goes along the path as a Cartesian
// pose controller would, by inverse kinematics from one sample to the next, and notes where the tip
// stays behind, where a joint is too fast or near its limit, and where the arm is singular.
#pragma once

#include <array>

#include "program/reach/inverse_kinematics.hpp"

namespace tactus {

struct Finding {
  enum Kind : std::uint8_t {
    kOutOfReach,    ///< no joints bring the tip there: `value` m and `angle_rad` remain
    kOtherPosture,  ///< joints bring it there, but not on this path: the same
    kSingular,      ///< `value`: sigma, `limit`: where the damping begins
    kFastJoint,     ///< `value` and `limit`, rad/s, of `joint`
    kNearLimit,     ///< `value` and `limit`, rad, of `joint`
  };
  static constexpr std::size_t kKinds = 5;

  Kind kind = kOutOfReach;
  double from_s = 0.0, to_s = 0.0;  ///< first and last sample, path time
  double worst_s = 0.0;             ///< that of the values
  Vector3 place = Vector3::Zero();  ///< of the tip then, base frame, m
  int joint = -1;                   ///< the joint that is too fast, near or at its limit; -1: none
  double value = 0.0, limit = 0.0, angle_rad = 0.0;
  double severity = 0.0;  ///< grows with what is wrong
};

class PathCheck {
 public:
  static constexpr std::size_t kMostFindings = 64;
  static constexpr double kNear_rad = 0.02;

  /// Begins with the arm at `q`, rad.
  PathCheck(const InverseKinematics& arm, const JointVector& q)
      : arm_(arm), posture_(q), q_(q), before_(q) {}

  /// Goes straight to the beginning of the path, at which nothing is judged.
  void approach(const Pose& first);
  /// Goes on to the pose of path time `time_s`; the times rise.
  void go_on(double time_s, const Pose& pose);

  int count() const { return static_cast<int>(count_); }
  const Finding& operator[](int i) const { return findings_[static_cast<std::size_t>(i)]; }
  /// Findings beyond the most that are kept.
  int left_out() const { return left_out_; }
  /// True if a pose was out of reach, in whichever finding.
  bool out_of_reach() const { return out_of_reach_; }

 private:
  bool elsewhere(const Pose& pose);
  bool found_elsewhere(const Pose& pose) const;
  void judge_reach(Finding found, const Pose& pose, const Reach& reach);
  void judge_limits(const Finding& found);
  void judge_speeds(const Finding& found, double passed_s);
  void note(const Finding& found);
  void end(Finding::Kind kind) { open_[kind] = nullptr; }

  const InverseKinematics& arm_;
  JointVector posture_, q_, before_;
  double time_s_ = 0.0;
  bool begun_ = false, reached_ = false;  // at the last sample
  int searches_ = 0;
  bool elsewhere_ = false;  // by the last of them
  bool out_of_reach_ = false;
  std::array<Finding, kMostFindings> findings_;
  std::array<Finding, Finding::kKinds> beyond_;   // in place of those that do not fit
  std::array<Finding*, Finding::kKinds> open_{};  // that the next sample may continue
  std::size_t count_ = 0;
  int left_out_ = 0;
};

}  // namespace tactus
