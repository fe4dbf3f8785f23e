// TaskSpace: what a reference generator needs to know of the space it moves in, here that of the
// tool tip in the base frame. The same members as JointSpace's.
//
// Orientations are unit quaternions; one that is off by no more than admission lets pass is made
// unit by whatever uses it. Its sign means nothing to any of this: see unit_beside().
#pragma once

#include "kernel/reference/interpolation.hpp"
#include "kernel/reference/offset_law.hpp"
#include "kernel/reference/peaks.hpp"
#include "kernel/reference/rotation_segment.hpp"
#include "kernel/reference/tolerance.hpp"
#include "kernel/reference/verdict.hpp"
#include "kernel/task_limits.hpp"

namespace tactus {

/// r as a unit quaternion, of its two signs the one nearer to `last`; a unit quaternion keeps its
/// bits. [any]
Eigen::Quaterniond unit_beside(const Eigen::Quaterniond& r, const Eigen::Quaterniond& last);

struct TaskSpace {
  using Limits = TaskLimits;
  static constexpr int kChannels = 2, kChannelSize = 3;  ///< translation and rotation: lengths
  using Peaks = MotionPeaks<kChannels>;
  using Levels = std::array<double, kChannels>;

  /// How far beside the reference a trajectory may begin.
  struct Tolerance {
    double position_m = 0.005, angle_rad = 0.02;
  };

  /// Largest distance and angle between desired and measured pose; 0 is not checked.
  struct Band {
    double position_m = 0.0, angle_rad = 0.0;
    static Band merged(const Band& goal, const Band& defaults);
  };

  /// A reference of the tool tip, in the base frame unless a client's terms name another one;
  /// linear part and force first.
  struct Point {
    Pose x;
    Vector6 v = Vector6::Zero();   ///< m/s, rad/s
    Vector6 a = Vector6::Zero();   ///< m/s^2, rad/s^2
    Vector6 h = Vector6::Zero();   ///< N, N m: what the environment is to exert on the tool
    Vector6 dh = Vector6::Zero();  ///< N/s, N m/s

    /// False if any number is NaN or infinite. [any]
    bool finite() const;
    /// True if velocity and acceleration are exactly zero. [any]
    bool standing() const;
    /// True if also the wrench and its rate are. [any]
    bool idle() const;
    /// The same pose, at rest, without feed-forward. [any]
    Point at_rest() const;
    /// The same pose, at rest, the wrench kept. [any]
    Point stopped() const;
    /// The pose and the `fields`, NaN in all others; the rate of a wrench is never measured. [any]
    Point as_measured(Fields fields) const;
    /// A point p(s), p', p'' of a path as it is passed at the rate r = ds/dt with slope dr/dt.
    /// [any]
    Point at_rate(double rate, double slope) const;
  };

  using Rates = Vector6;

  /// The frames that a client's references are given in: where they stand in the base frame, which
  /// is what null is. A moving frame is taken as it stands when the reference is accepted. A
  /// wrench is about the origin of its frame; in the base frame it is about the tip.
  struct Terms {
    const Pose* motion = nullptr;
    const Pose* wrench = nullptr;
  };
  /// The terms as they stand when a reference is accepted.
  struct Latched {
    Pose motion, wrench;
    bool moved = false, levered = false;  ///< the terms named a motion frame, a wrench frame
  };

  /// What a segment takes: bounds of the lengths, the room, and the wrench.
  struct Measure {
    Peaks peaks;
    std::array<double, kChannels> slowing{};       ///< largest acceleration against the motion
    Vector3 p_min = Vector3::Constant(kInfinity);  ///< m
    Vector3 p_max = Vector3::Constant(-kInfinity);
    double force = 0.0, moment = 0.0;  ///< N, N m
  };
  /// What a path takes: of the limits at its own rate, of the room, and of the wrench's limits.
  struct Use {
    double velocity = 0.0, acceleration = 0.0, jerk = 0.0;  ///< largest ratios to the limits
    bool slowed = false;  ///< these are above one: it is passed more slowly there
    Vector3 p_min = Vector3::Constant(kInfinity);  ///< m
    Vector3 p_max = Vector3::Constant(-kInfinity);
    double force = 0.0, moment = 0.0;  ///< N, N m
    /// Of a path of two parts. [any]
    static Use largest(const Use& a, const Use& b);
  };
  /// Derivatives of a path with respect to its time; those of the rotation are the angular velocity
  /// and its derivatives in the base, written in the axes of the tip, as only lengths count.
  struct Local {
    Rates d1, d2, d3;  ///< m/s, rad/s and so on
  };

  /// a - b of two references: x is the difference of the positions, m, and below it the rotation
  /// vector phi, rad, in b's frame: R_a = R_b exp(phi). dx and ddx are its derivatives.
  using Difference = Offset<6>;

  /// What a reference feeds forward.
  struct Effort {
    Vector6 h = Vector6::Zero();  ///< N, N m
  };

  /// desired - actual, in the base frame.
  struct Error {
    Vector3 p = Vector3::Zero();    ///< m
    Vector3 phi = Vector3::Zero();  ///< rad, rotation vector log(r_d r^-1) along the shortest arc
    Vector6 v = Vector6::Zero();    ///< m/s, rad/s
    Vector6 a = Vector6::Zero();    ///< m/s^2, rad/s^2
    Vector6 h = Vector6::Zero();    ///< N, N m
    Vector6 dh = Vector6::Zero();   ///< N/s, N m/s
  };

  /// Motion between two points in a given time: position by one polynomial per axis, orientation by
  /// a RotationSegment, velocity and acceleration their exact derivatives, wrench linear. Linear is
  /// a straight line and slerp.
  class Segment {
   public:
    Segment() = default;
    /// `fields` are those both ends have; T > 0 in seconds. The orientation begins with the sign of
    /// from's, the sign of to's is ignored. [any]
    Segment(const Point& from, const Point& to, double T, Interpolation how, Fields fields);

    Point at(double t) const;
    /// [cyclic]
    Local local(double t) const;
    double duration() const { return rotation_.duration(); }
    /// What it is from `begin` on for so long. [any]
    Segment part(double begin, double duration) const;
    /// Its beginning without what steps there by nature: the velocity of a straight line, the
    /// acceleration of a cubic. [any]
    Point corner() const;
    const VectorPolynomial& translation() const { return p_; }
    const RotationSegment& rotation() const { return rotation_; }

   private:
    VectorPolynomial p_;
    RotationSegment rotation_;
    Vector6 h_ = Vector6::Zero(), dh_ = Vector6::Zero();  // wrench at the start, and its rate
    Interpolation order_ = Interpolation::kLinear;
  };

  // Axes of a verdict: 0, 1, 2 are x, y, z, and 3, 4, 5 the rotations about them. Where a vector's
  // length counts it is 0 for translation and force, 3 for rotation and moment.

  /// Judges what no time can mend in a waypoint: finite, unit quaternion, workspace, wrench.
  /// [cyclic]
  static Verdict judge_waypoint(const Point& point, const Limits& limits);
  /// Judges one online point: finite, unit quaternion within 1e-3, workspace, speeds, wrench.
  /// [cyclic]
  static Verdict judge(const Point& point, const Limits& limits);
  /// Velocity, acceleration and jerk limits. [any]
  static Peaks peaks(const Limits& limits);
  /// What a segment takes: the position at its extrema, the lengths of velocity, acceleration and
  /// jerk by bounds from outside (translation_bounds.hpp, rotation_segment.hpp), so that none
  /// beyond a limit is missed. The wrench between ends within limits is within them. [cyclic, some
  /// microseconds]
  static Measure measure(const Segment& segment, const Limits& limits, const Peaks& most);
  /// Judges the room that a segment takes. [cyclic]
  static Verdict judge_room(const Measure& measure, const Limits& limits);
  /// Judges the end of a trajectory: nothing follows it, so whoever arrives there must stand. [any]
  static Verdict judge_end(const Point& end);
  /// Judges distance and angle of two poses against a tolerance. [cyclic]
  static Verdict judge_near(const Point& a, const Point& b, const Tolerance& tolerance);
  /// Judges the length of a step in velocity; as JointSpace's. [cyclic]
  static Verdict judge_step(const Point& before, const Point& after, const Limits& limits,
                            double dt_s, Levels& level);
  /// Judges whether `to` can be put out one period after `from`: kVelocityLimit if not. [cyclic]
  static Verdict judge_reach(const Point& from, const Point& to, const Limits& limits, double dt_s);
  /// Judges a pose error; the verdict has `code`. An error that is NaN exceeds every band. [cyclic]
  static Verdict judge_error(const Point& desired, const Point& measured, const Band& band,
                             Status code);
  /// Judges a measured twist, m/s and rad/s against the one `limit`; 0: not checked. [cyclic]
  static Verdict judge_stopped(const Point& measured, double limit);
  /// A measure as a use of the limits. [cyclic]
  static Use use(const Measure& measure, const Peaks& limits);
  /// Of a point at which nothing moves. [cyclic]
  static Use use(const Point& held);
  /// The terms as of now. [cyclic]
  static Latched latch(const Terms& terms, const Point& reference, const Limits& limits);
  /// Terms for admission, to which the frames are unknown. [any]
  static Latched anywhere(const Terms&, const Limits&) { return {}; }
  /// The limits that can be judged in a client's terms: no box in a frame that is not the base, no
  /// moment about another point than the tip. [any]
  static Limits known_limits(const Terms& terms, const Limits& limits);
  /// A client's point with zeros where its fields are not given. [cyclic]
  static Point only(Fields given, const Point& point);
  /// A client's point as a reference in the base frame. [cyclic]
  static Point placed(const Point& given, const Latched& terms);
  /// Of the tip nothing is held. [cyclic]
  static Point without_held(const Point& reference, const Latched&) { return reference; }
  /// The use of a path of a client's points as that of their references; boxes and moments are
  /// bounds from outside. [cyclic]
  static Use placed(const Use& given, const Latched& terms);
  /// Judges what known_limits() could not: box and moment. [cyclic]
  static Verdict judge_placed(const Use& placed, const Latched& terms, const Limits& limits);

  /// The twist of a straight line and slerp from one point to the other in T seconds. [any]
  static Rates secant(const Point& from, const Point& to, double T);
  static Rates& rates(Point& point) { return point.v; }

  /// a - b along the shortest arc, and b + difference = a but for the quaternion's sign and the
  /// wrench, which is b's. [any]
  static Difference difference(const Point& a, const Point& b);
  static Point sum(const Point& b, const Difference& difference);
  /// [any]
  static Error error(const Point& desired, const Point& actual);

  /// What a feeds forward beyond b; and adds `left` of it, which changes at `rate` 1/s. [any]
  static Effort effort_beyond(const Point& a, const Point& b) { return {a.h - b.h}; }
  static void add_effort(Point& point, const Effort& effort, double left, double rate) {
    point.h += left * effort.h;
    point.dh += rate * effort.h;
  }

  /// What an offset in motion leaves of the limits to the path it goes to. [cyclic]
  static Peaks left_to_path(const Limits& limits, const Difference& offset);
  /// The reference one period on, on its way to a base that moves from `base` to `next` in that
  /// period, and its offset from it likewise: within all limits if it is within them now, but for
  /// what a base that `steps` by nature does. [cyclic]
  static Point approach(const Point& reference, Difference& offset, const Point& base,
                        const Point& next, bool steps, const Limits& limits, double dt_s);
  /// The reference one period on, translation and rotation on their stops. [cyclic]
  static Point come_to_rest(const Point& reference, const Limits& limits, double dt_s);
  /// Where that way ends; the orientation but for what turnings about other axes do not commute.
  /// [cyclic]
  static Point rest_of(const Point& reference, const Limits& limits);
};

}  // namespace tactus
