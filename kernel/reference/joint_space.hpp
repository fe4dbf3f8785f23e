// JointSpace: what a reference generator needs to know of the space it moves in, here the joints.
// Every space has the same members; task_space.hpp is the other one.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/joint_limits.hpp"
#include "kernel/reference/interpolation.hpp"
#include "kernel/reference/offset_law.hpp"
#include "kernel/reference/path_use.hpp"
#include "kernel/reference/polynomial.hpp"
#include "kernel/reference/tolerance.hpp"
#include "kernel/reference/verdict.hpp"

namespace tactus {

struct JointSpace {
  using Limits = JointLimits;

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

  /// What a path takes: of the limits, and of the room.
  struct Use : PathUse {
    JointVector q_min = JointVector::Constant(kInfinity);  ///< rad
    JointVector q_max = JointVector::Constant(-kInfinity);
    /// Of a path of two parts. [any]
    static Use largest(const Use& a, const Use& b);
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

  /// Judges one online point: finite and within position, velocity and effort limits. [cyclic]
  static Verdict judge(const Point& point, const Limits& limits);
  /// Judges one segment at its extrema, acceleration and jerk against the fraction `share` of their
  /// limits. [cyclic, some microseconds]
  static Verdict judge(const Segment& segment, const Limits& limits, double share);
  /// Judges the end of a trajectory: nothing follows it, so whoever arrives there must stand. [any]
  static Verdict judge_end(const Point& end);
  /// Judges the distance of two positions against a tolerance. [cyclic]
  static Verdict judge_near(const Point& a, const Point& b, const Tolerance& tolerance);
  /// Judges the step in velocity from one segment's end to the next one's beginning. [cyclic]
  static Verdict judge_step(const Point& before, const Point& after, const Limits& limits);
  /// Judges whether `to` can be put out one period after `from`: kVelocityLimit if not. [cyclic]
  static Verdict judge_reach(const Point& from, const Point& to, const Limits& limits, double dt_s);
  /// Judges a position error; the verdict has `code`. An error that is NaN exceeds every band.
  /// [cyclic]
  static Verdict judge_error(const Point& desired, const Point& measured, const Band& band,
                             Status code);
  /// Judges a measured velocity against one limit for all joints, rad/s; 0: not checked. [cyclic]
  static Verdict judge_stopped(const Point& measured, double limit);
  /// What a segment takes of the limits at its extrema, and of the room by a bound from outside; as
  /// `known` where it takes no more. [cyclic]
  static Use use(const Segment& segment, const Limits& limits, const Use& known);
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
  /// A client's point as a reference of all joints. [cyclic]
  static Point placed(const Point& given, const Latched& terms);
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

  /// The reference one period on, on its way to a base that moves from `base` to `next` in that
  /// period, and its offset from it likewise: within all limits if it is within them now, but for
  /// what the base steps by nature. [cyclic]
  static Point approach(const Point& reference, Difference& offset, const Point& base,
                        const Point& next, const Limits& limits, double dt_s);
  /// The reference one period on, every joint on its fastest way to rest. [cyclic]
  static Point come_to_rest(const Point& reference, const Limits& limits, double dt_s);
  /// Where that way ends. [cyclic]
  static Point rest_of(const Point& reference, const Limits& limits);
};

}  // namespace tactus
