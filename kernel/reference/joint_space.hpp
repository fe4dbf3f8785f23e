// JointSpace: what a reference generator needs to know of the space it moves in, here the joints.
// Every space has the same members; task_space.hpp is the other one.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/joint_limits.hpp"
#include "kernel/reference/interpolation.hpp"
#include "kernel/reference/offset_law.hpp"
#include "kernel/reference/peaks.hpp"
#include "kernel/reference/polynomial.hpp"
#include "kernel/reference/tolerance.hpp"
#include "kernel/reference/verdict.hpp"

namespace tactus {

struct JointSpace {
  using Limits = JointLimits;
  static constexpr int kChannels = kDof, kChannelSize = 1;  ///< what limits are counted by
  using Peaks = MotionPeaks<kChannels>;
  using Levels = std::array<double, kChannels>;

  /// How far beside the reference a trajectory may begin.
  struct Tolerance {
    JointVector q = JointVector::Constant(0.01);  ///< rad
  };

  /// Largest position error per joint, rad; 0 is not checked.
  struct Band {
    JointVector q = JointVector::Zero();
    static Band merged(const Band& goal, const Band& defaults);
  };

  /// A reference of all joints.
  struct Point {
    JointVector q = JointVector::Zero();    ///< rad
    JointVector dq = JointVector::Zero();   ///< rad/s
    JointVector ddq = JointVector::Zero();  ///< rad/s^2
    JointVector tau = JointVector::Zero();  ///< N m, feed-forward

    /// False if any number is NaN or infinite. [any]
    bool finite() const;
    /// True if velocity and acceleration are exactly zero. [any]
    bool standing() const;
    /// True if there is no feed-forward either. [any]
    bool idle() const;
    /// The same position, at rest, without feed-forward. [any]
    Point at_rest() const;
    /// The same position and feed-forward, at rest. [any]
    Point stopped() const;
    /// The position and the `fields`, NaN in all others. [any]
    Point as_measured(Fields fields) const;
    /// A point p(s), p', p'' of a path as it is passed at the rate r = ds/dt with slope dr/dt.
    /// [any]
    Point at_rate(double rate, double slope) const;
  };
  using Error = Point;              ///< desired - actual, in every field
  using Difference = Offset<kDof>;  ///< a - b of two references, rad and its derivatives
  using Rates = JointVector;

  /// What a reference feeds forward.
  struct Effort {
    JointVector tau = JointVector::Zero();  ///< N m
  };

  /// Which joints the references of a client give: bit i of `held` is joint i, which keeps where it
  /// is when the reference is accepted.
  struct Terms {
    std::uint32_t held = 0;
  };
  /// The terms as they stand when a reference is accepted.
  struct Latched {
    std::uint32_t held = 0;
    JointVector q = JointVector::Zero();  ///< rad, of the joints that are held
  };

  /// What a segment takes: the largest of each derivative, and the room.
  struct Measure {
    Peaks peaks;
    std::array<double, kChannels> slowing{};               ///< largest |ddq| against dq, rad/s^2
    JointVector q_min = JointVector::Constant(kInfinity);  ///< rad
    JointVector q_max = JointVector::Constant(-kInfinity);
  };
  /// What a path takes: of the limits at its own rate, and of the room.
  struct Use {
    double velocity = 0.0, acceleration = 0.0, jerk = 0.0;  ///< largest ratios to the limits
    bool slowed = false;  ///< these are above one: it is passed more slowly there
    JointVector q_min = JointVector::Constant(kInfinity);  ///< rad
    JointVector q_max = JointVector::Constant(-kInfinity);
    /// Of a path of two parts. [any]
    static Use largest(const Use& a, const Use& b);
  };
  /// Derivatives of a path with respect to its time.
  struct Local {
    Rates d1, d2, d3;  ///< rad/s, rad/s^2, rad/s^3
  };
  /// Motion between two points in a given time: position by one polynomial per joint, velocity and
  /// acceleration its exact derivatives, effort linear.
  class Segment {
   public:
    Segment() = default;
    /// `fields` are those both ends have; T > 0 in seconds. [any]
    Segment(const Point& from, const Point& to, double T, Interpolation how, Fields fields);

    Point at(double t) const;
    /// [cyclic]
    Local local(double t) const;
    double duration() const { return duration_; }
    /// What it is from `begin` on for so long. [any]
    Segment part(double begin, double duration) const;
    /// Its beginning without what steps there by nature: the velocity of a straight line, the
    /// acceleration of a cubic. [any]
    Point corner() const;
    const Polynomial& position(int joint) const { return q_[static_cast<std::size_t>(joint)]; }

   private:
    std::array<Polynomial, kDof> q_;
    JointVector tau_from_ = JointVector::Zero(), tau_to_ = JointVector::Zero();
    double duration_ = 1.0;
    Interpolation order_ = Interpolation::kLinear;
  };

  /// Judges what no time can mend in a waypoint: finite, range and effort. [cyclic]
  static Verdict judge_waypoint(const Point& point, const Limits& limits);
  /// Judges one online point: finite and within position, velocity and effort limits. [cyclic]
  static Verdict judge(const Point& point, const Limits& limits);
  /// Velocity, acceleration and jerk limits. [any]
  static Peaks peaks(const Limits& limits);
  /// What a segment takes: exact where it is beyond `most` or a position limit, else a bound from
  /// outside. [cyclic, some microseconds]
  static Measure measure(const Segment& segment, const Limits& limits, const Peaks& most);
  /// Judges the room that a segment takes. [cyclic]
  static Verdict judge_room(const Measure& measure, const Limits& limits);
  /// Judges the end of a trajectory: nothing follows it, so whoever arrives there must stand. [any]
  static Verdict judge_end(const Point& end);
  /// Judges the distance of two positions against a tolerance. [cyclic]
  static Verdict judge_near(const Point& a, const Point& b, const Tolerance& tolerance);
  /// Judges the step in velocity from one segment's end to the next one's beginning, dt seconds
  /// after the one before. Steps add up in `level`, from which the acceleration limit takes away in
  /// time what it can: so close steps count as one. [cyclic]
  static Verdict judge_step(const Point& before, const Point& after, const Limits& limits,
                            double dt_s, Levels& level);
  /// Judges whether `to` can be put out one period after `from`: kVelocityLimit if not. [cyclic]
  static Verdict judge_reach(const Point& from, const Point& to, const Limits& limits, double dt_s);
  /// Judges a position error; the verdict has `code`. An error that is NaN exceeds every band.
  /// [cyclic]
  static Verdict judge_error(const Point& desired, const Point& measured, const Band& band,
                             Status code);
  /// Judges a measured velocity against one limit for all joints, rad/s; 0: not checked. [cyclic]
  static Verdict judge_stopped(const Point& measured, double limit);
  /// A measure as a use of the limits. [cyclic]
  static Use use(const Measure& measure, const Peaks& limits);
  /// Of a point at which nothing moves. [cyclic]
  static Use use(const Point& held);
  /// The terms as of now, with `reference` put out: joints that are held come to rest where they
  /// can first. [cyclic]
  static Latched latch(const Terms& terms, const Point& reference, const Limits& limits);
  /// Terms for admission, to which where the robot is then is unknown: joints that are held stand
  /// in the middle of their ranges. [any]
  static Latched anywhere(const Terms& terms, const Limits& limits);
  /// The limits that can be judged in a client's terms: all of them. [any]
  static Limits known_limits(const Terms&, const Limits& limits) { return limits; }
  /// A client's point with zeros where its fields are not given. [cyclic]
  static Point only(Fields given, const Point& point);
  /// A client's point as a reference of all joints. [cyclic]
  static Point placed(const Point& given, const Latched& terms);
  /// A reference whose held joints stand where they are held. [cyclic]
  static Point without_held(const Point& reference, const Latched& terms) {
    return placed(reference, terms);
  }
  /// The use of a path of a client's points as that of their references. [cyclic]
  static Use placed(const Use& given, const Latched& terms);
  /// Judges what known_limits() could not: nothing. [cyclic]
  static Verdict judge_placed(const Use&, const Latched&, const Limits&) { return {}; }

  /// The velocity of a straight line from one point to the other in T seconds, rad/s. [any]
  static Rates secant(const Point& from, const Point& to, double T) { return (to.q - from.q) / T; }
  static Rates& rates(Point& point) { return point.dq; }

  /// a - b, and b + difference = a but for the effort, which is b's. [any]
  static Difference difference(const Point& a, const Point& b);
  static Point sum(const Point& b, const Difference& difference);
  /// [any]
  static Error error(const Point& desired, const Point& actual);

  /// What a feeds forward beyond b; and adds `left` of it, which changes at `rate` 1/s. [any]
  static Effort effort_beyond(const Point& a, const Point& b) { return {a.tau - b.tau}; }
  static void add_effort(Point& point, const Effort& effort, double left, double /*rate*/) {
    point.tau += left * effort.tau;
  }

  /// What an offset in motion leaves of the limits to the path it goes to. [cyclic]
  static Peaks left_to_path(const Limits& limits, const Difference& offset);
  /// The reference one period on, on its way to a base that moves from `base` to `next` in that
  /// period, and its offset from it likewise: within all limits if it is within them now, but for
  /// what a base that `steps` by nature does. [cyclic]
  static Point approach(const Point& reference, Difference& offset, const Point& base,
                        const Point& next, bool steps, const Limits& limits, double dt_s);
  /// The reference one period on, every joint on its fastest way to rest. [cyclic]
  static Point come_to_rest(const Point& reference, const Limits& limits, double dt_s);
  /// Where that way ends. [cyclic]
  static Point rest_of(const Point& reference, const Limits& limits);
};

}  // namespace tactus
