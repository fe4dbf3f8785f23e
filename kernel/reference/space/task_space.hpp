// TaskSpace: the tool tip in the base frame as a Space. space.hpp documents the members it has in
// common with JointSpace; here are its data and what is special in them.
//
// Orientations are unit quaternions. One that is off by no more than admission accepts is made unit
// where it is used. Its sign has no meaning except in keep_sign() and unit_beside().
#pragma once

#include "kernel/core/task_limits.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/reference/space/interpolation.hpp"
#include "kernel/reference/space/offset_law.hpp"
#include "kernel/reference/space/peaks.hpp"
#include "kernel/reference/space/rotation_segment.hpp"
#include "kernel/reference/space/space.hpp"
#include "kernel/reference/space/tolerance.hpp"

namespace tactus {

/// Returns r if its length is one to rounding, else r normalized. [any]
Eigen::Quaterniond unit(const Eigen::Quaterniond& r);

/// Returns r as a unit quaternion, of its two signs the one nearer to `last`; a quaternion that is
/// unit keeps its bits. [any]
Eigen::Quaterniond unit_beside(const Eigen::Quaterniond& r, const Eigen::Quaterniond& last);

struct TaskSpace {
  using Limits = TaskLimits;
  static constexpr int kChannels = 2, kChannelSize = 3;
  static constexpr bool kHeldByLaw = false;
  using Peaks = MotionPeaks<kChannels>;          ///< lengths; m/s and rad/s, and so on
  using Levels = std::array<double, kChannels>;  ///< translation, rotation

  struct Tolerance {
    double position_m = 0.005, angle_rad = 0.02;
  };

  struct Band {
    double position_m = 0.0, angle_rad = 0.0;
    static Band merged(const Band& goal, const Band& defaults);
  };

  /// A reference of the tool tip, in the base frame unless a client's header names another one.
  struct Point {
    Pose x;
    Vector6 v = Vector6::Zero();   ///< m/s, rad/s
    Vector6 a = Vector6::Zero();   ///< m/s^2, rad/s^2
    Vector6 h = Vector6::Zero();   ///< N, N m: what the environment is to exert on the tool
    Vector6 dh = Vector6::Zero();  ///< N/s, N m/s

    bool finite() const;
    bool standing() const;
    bool idle() const;
    Point at_rest() const;
    Point stopped() const;
    /// The rate of the wrench is never measured.
    Point as_measured(Fields fields) const;
    Point at_rate(double rate, double slope) const;
  };

  using Rates = Vector6;  ///< m/s, rad/s

  /// The frames that a client's references are given in, as poses in the base frame; null is the
  /// base frame. A wrench is about the origin of its frame; in the base frame it is about the tip.
  struct Header {
    const Pose* motion = nullptr;
    const Pose* wrench = nullptr;
  };
  struct Placement {
    Pose motion, wrench;
    bool moved = false, levered = false;  ///< the header named a motion frame, a wrench frame
  };

  /// The box that the path covers, its largest force and its largest moment.
  struct Extent {
    bool slowed = false;
    Vector3 p_min = Vector3::Constant(kInfinity);  ///< m
    Vector3 p_max = Vector3::Constant(-kInfinity);
    double force = 0.0, moment = 0.0;  ///< N, N m
    /// True of no waypoints: the last part of a stream may have none.
    bool empty() const { return p_min[0] > p_max[0]; }
    static Extent largest(const Extent& a, const Extent& b);
  };
  struct Measure {
    Peaks peaks;
    Levels slowing{};  ///< upper bound: the largest acceleration, m/s^2, rad/s^2
    Extent extent;
  };
  /// The derivatives of the rotation are the angular velocity and its derivatives in the base
  /// frame, written in the axes of the tip, since only lengths count.
  struct Local {
    Rates d1, d2, d3;  ///< m/s, rad/s and so on
  };

  /// x is the difference of the positions in m, followed by the rotation vector phi in rad along
  /// the shortest arc, in b's frame: R_a = R_b exp(phi). dx and ddx are its derivatives.
  using Difference = Offset<6>;

  struct Effort {
    Vector6 h = Vector6::Zero();  ///< N, N m
  };

  /// In the base frame.
  struct Error {
    Vector3 p = Vector3::Zero();    ///< m
    Vector3 phi = Vector3::Zero();  ///< rad, rotation vector log(r_d r^-1) along the shortest arc
    Vector6 v = Vector6::Zero();    ///< m/s, rad/s
    Vector6 a = Vector6::Zero();    ///< m/s^2, rad/s^2
    Vector6 h = Vector6::Zero();    ///< N, N m
    Vector6 dh = Vector6::Zero();   ///< N/s, N m/s
  };

  /// Position by one polynomial per axis, orientation by a RotationSegment. Linear is a straight
  /// line and slerp.
  class Segment {
   public:
    Segment() = default;
    /// The orientation begins with the sign of from's quaternion; the sign of to's is ignored.
    Segment(const Point& from, const Point& to, double T, Interpolation how, Fields fields);

    Point at(double t) const;
    Local local(double t) const;
    Vector6 wrench(double t) const { return h_ + t * dh_; }  ///< N, N m
    double duration() const { return rotation_.duration(); }
    Segment part(double begin, double duration) const;
    Point corner() const;
    const VectorPolynomial& translation() const { return p_; }
    const RotationSegment& rotation() const { return rotation_; }

   private:
    Interpolation order_ = Interpolation::kLinear;
    VectorPolynomial p_;
    RotationSegment rotation_;
    Vector6 h_ = Vector6::Zero(), dh_ = Vector6::Zero();  // wrench at the start, and its rate
  };

  /// Also refuses a quaternion whose length is off by more than 1e-3: kQuaternion.
  static Verdict judge_waypoint(const Point& point, const Limits& limits);
  static Verdict saturate(Point& point, const Limits& limits);
  static Peaks peaks(const Limits& limits);
  /// The box by the Bernstein hull, or exactly if the hull leaves the workspace or the workspace is
  /// not known yet, unless `accuracy` is kQuick. Lengths by the upper bounds of vector_bounds.hpp,
  /// so no violation is missed; `most` is not used. The wrench is linear and so largest at an end.
  static Measure measure(const Segment& segment, const Limits& limits, const Peaks& most,
                         Accuracy accuracy = Accuracy::kFine);
  static Verdict judge_room(const Measure& measure, const Limits& limits, const Point& from);
  /// Judges distance and angle.
  static Verdict judge_near(const Point& a, const Point& b, const Tolerance& tolerance);
  static Verdict judge_step(const Point& before, const Point& after, const Limits& limits,
                            double dt_s, Levels& level);
  static Verdict judge_error(const Point& desired, const Point& measured, const Band& band,
                             Status code);
  static Extent extent_of(const Measure& measure) { return measure.extent; }
  static Extent extent_of(const Point& held);
  static Placement latch(const Header& header, const Point& reference, const Limits& limits);
  /// All frames are the base frame.
  static Placement anywhere(const Header&, const Limits&) { return {}; }
  /// No box if there is a motion frame, no largest moment if there is a wrench frame.
  static Limits known_limits(const Header& header, const Limits& limits);
  static constexpr int numbers(Fields given) {
    return given & kEffortField         ? 31
           : given & kAccelerationField ? 19
           : given & kVelocityField     ? 13
                                        : 7;
  }
  static Point only(Fields given, const double* numbers);
  static Point placed(const Point& given, const Placement& placement);
  /// The tip has no joints to hold: returns the reference as it is.
  static Point without_held(const Point& reference, const Placement&) { return reference; }
  /// Box and moment become upper bounds.
  static Extent placed(const Extent& given, const Placement& placement);
  /// Judges the box and the moment.
  static Verdict judge_placed(const Extent& placed, const Placement& placement,
                              const Limits& limits);

  /// The twist of a straight line and slerp.
  static Rates secant(const Point& from, const Point& to, double T);
  static Rates& rates(Point& point) { return point.v; }
  static const Rates& rates(const Point& point) { return point.v; }

  static void keep_sign(Point& point, const Point& before);
  static Difference difference(const Point& a, const Point& b);
  static Point sum(const Point& b, const Difference& difference);
  static Error error(const Point& desired, const Point& actual);

  static Effort effort_beyond(const Point& a, const Point& b) { return {a.h - b.h}; }
  static void add_effort(Point& point, const Effort& effort, double left, double rate) {
    point.h += left * effort.h;
    point.dh += rate * effort.h;
  }

  static Point approach(const Point& reference, Difference& offset, const Point& base,
                        const Point& next, bool steps, const Limits& limits, double dt_s);
  static bool can_stop(const Point& reference, const Limits& limits, double dt_s);
  /// Translation and rotation stop independently of each other (vector_stop.hpp).
  static Point come_to_rest(const Point& reference, const Limits& limits, double dt_s);
  /// The part of a point that position ranges bound.
  using Place = Vector3;
  static const Place& place(const Point& point) { return point.x.p; }
  /// Returns the limits with a range of positions that is no wider than from `lowest` to `highest`.
  /// [cyclic]
  static Limits narrowed(const Limits& limits, const Place& lowest, const Place& highest) {
    Limits narrow = limits;
    narrow.p_min = limits.p_min.cwiseMax(lowest);
    narrow.p_max = limits.p_max.cwiseMin(highest);
    return narrow;
  }
  /// Approximate: the stop in one step instead of in periods.
  static Point rest_of(const Point& reference, const Limits& limits);
  /// Translation and rotation go to their velocities independently, each on a straight line.
  static Point go_at(const Point& reference, const Rates& rates, const Limits& limits,
                     double acceleration, double jerk, double dt_s);
  static Rates in_base(const Rates& rates, const Point& tip);
};
static_assert(SpaceContract<TaskSpace>());

}  // namespace tactus
