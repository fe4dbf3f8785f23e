// JointSpace: what a reference generator needs to know of the space it moves in, here the joints.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/joint_limits.hpp"
#include "kernel/reference/polynomial.hpp"
#include "kernel/types.hpp"

namespace tactus {

/// Which fields of a waypoint are given; the position always is.
enum Field : std::uint8_t { kVelocityField = 1, kAccelerationField = 2, kEffortField = 4 };
using Fields = std::uint8_t;

/// How waypoints are joined: by the fields both ends have, or forced.
enum class Interpolation : std::uint8_t { kByFields, kLinear, kCubic, kQuintic };

struct JointSpace {
  /// A reference of all joints.
  struct Point {
    JointVector q = JointVector::Zero();    ///< rad
    JointVector dq = JointVector::Zero();   ///< rad/s
    JointVector ddq = JointVector::Zero();  ///< rad/s^2
    JointVector tau = JointVector::Zero();  ///< N m, feed-forward

    /// False if any number is NaN or infinite. [any]
    bool finite() const;
    /// The same position, at rest, without feed-forward. [any]
    Point at_rest() const;
  };

  /// Motion between two points in a given time: position by one polynomial per joint, velocity and
  /// acceleration its exact derivatives, effort linear.
  class Segment {
   public:
    Segment() = default;
    /// `fields` are those both ends have; T > 0 in seconds. [any]
    Segment(const Point& from, const Point& to, double T, Interpolation how, Fields fields);

    Point at(double t) const;
    double duration() const { return duration_; }
    bool linear() const { return linear_; }
    const Polynomial& position(int joint) const { return q_[static_cast<std::size_t>(joint)]; }

   private:
    std::array<Polynomial, kDof> q_;
    JointVector tau_from_ = JointVector::Zero(), tau_to_ = JointVector::Zero();
    double duration_ = 1.0;
    bool linear_ = true;
  };

  /// Difference of two references in position, velocity, acceleration and effort, and its inverse.
  /// [any]
  static Point difference(const Point& a, const Point& b);
  static Point sum(const Point& a, const Point& b);

  /// Seconds in which a quintic takes `difference` to zero with at most half of each velocity and
  /// acceleration limit, or what the difference begins with where that is more; the other half is
  /// left to the motion underneath. An acceleration it begins with adds up to 0.068 ddq T to the
  /// velocity. [any]
  static double bridge_time_s(const Point& difference, const JointLimits& limits);
  /// Seconds in which all joints stop together with at most half of each acceleration limit, or
  /// what they begin with where that is more. [any]
  static double brake_time_s(const Point& moving, const JointLimits& limits);
  /// Where a stop from `moving` in T seconds comes to rest, velocity being a cubic in time; cut to
  /// the position limits. [any]
  static Point stop(const Point& moving, double T, const JointLimits& limits);
};

}  // namespace tactus
