// JointSpace: the joints as a Space. space.hpp documents the members it has in common with
// TaskSpace; here are its data and what is special in them.
#pragma once

#include <array>
#include <cstdint>

#include "kernel/core/joint_limits.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/reference/space/interpolation.hpp"
#include "kernel/reference/space/offset_law.hpp"
#include "kernel/reference/space/peaks.hpp"
#include "kernel/reference/space/polynomial.hpp"
#include "kernel/reference/space/space.hpp"
#include "kernel/reference/space/tolerance.hpp"

namespace tactus {

struct JointSpace {
  using Limits = JointLimits;
  static constexpr int kChannels = kDof, kChannelSize = 1;
  static constexpr bool kHeldByLaw = true;
  using Peaks = MotionPeaks<kChannels>;  ///< rad/s, rad/s^2, rad/s^3
  using Levels = std::array<double, kChannels>;

  struct Tolerance {
    JointVector q = JointVector::Constant(0.01);  ///< rad
  };

  struct Band {
    JointVector q = JointVector::Zero();  ///< rad
    static Band merged(const Band& goal, const Band& defaults);
  };

  /// A reference of all joints.
  struct Point {
    JointVector q = JointVector::Zero();    ///< rad
    JointVector dq = JointVector::Zero();   ///< rad/s
    JointVector ddq = JointVector::Zero();  ///< rad/s^2
    JointVector tau = JointVector::Zero();  ///< N m, feed-forward

    bool finite() const;
    bool standing() const;
    bool idle() const;
    Point at_rest() const;
    Point stopped() const;
    Point as_measured(Fields fields) const;
    Point at_rate(double rate, double slope) const;
  };
  using Error = Point;
  using Difference = Offset<kDof>;  ///< rad, rad/s, rad/s^2
  using Rates = JointVector;        ///< rad/s

  struct Effort {
    JointVector tau = JointVector::Zero();  ///< N m
  };

  /// Bit i of `held`: the references leave joint i out. It holds the position at which it comes to
  /// rest when the header is resolved.
  struct Header {
    std::uint32_t held = 0;
  };
  struct Placement {
    std::uint32_t held = 0;
    JointVector q = JointVector::Zero();  ///< rad, used for the joints that are held
  };

  struct Measure {
    Peaks peaks;
    std::array<double, kChannels> slowing{};               ///< largest |ddq| against dq, rad/s^2
    JointVector q_min = JointVector::Constant(kInfinity);  ///< rad
    JointVector q_max = JointVector::Constant(-kInfinity);
  };
  /// No joint limit depends on the placement, so neither position nor effort is noted.
  struct Extent {
    bool slowed = false;
    static Extent largest(const Extent& a, const Extent& b) { return {a.slowed || b.slowed}; }
  };
  struct Local {
    Rates d1, d2, d3;  ///< rad/s, rad/s^2, rad/s^3
  };
  /// One polynomial per joint.
  class Segment {
   public:
    Segment() = default;
    Segment(const Point& from, const Point& to, double T, Interpolation how, Fields fields);

    Point at(double t) const;
    Local local(double t) const;
    double duration() const { return duration_; }
    Segment part(double begin, double duration) const;
    Point corner() const;
    Polynomial position(int joint) const { return axis_of(q_, joint); }

   private:
    Interpolation order_ = Interpolation::kLinear;
    PolynomialOf<JointVector> q_;
    JointVector tau_from_ = JointVector::Zero(), tau_to_ = JointVector::Zero();
    double duration_ = 1.0;
  };

  static Verdict judge_waypoint(const Point& point, const Limits& limits);
  static Verdict saturate(Point& point, const Limits& limits);
  static Peaks peaks(const Limits& limits);
  /// Bounds by the Bernstein hull, replaced by the exact extrema where they exceed `most` or a
  /// position limit, unless `accuracy` is kQuick.
  static Measure measure(const Segment& segment, const Limits& limits, const Peaks& most,
                         Accuracy accuracy = Accuracy::kFine);
  static Verdict judge_room(const Measure& measure, const Limits& limits, const Point& from);
  static Verdict judge_near(const Point& a, const Point& b, const Tolerance& tolerance);
  static Verdict judge_step(const Point& before, const Point& after, const Limits& limits,
                            double dt_s, Levels& level);
  static Verdict judge_error(const Point& desired, const Point& measured, const Band& band,
                             Status code);
  static Extent extent_of(const Measure&) { return {}; }
  static Extent extent_of(const Point&) { return {}; }
  /// The held joints come to rest on their fastest way from `reference`.
  static Placement latch(const Header& header, const Point& reference, const Limits& limits);
  /// The held joints are in the middle of their ranges.
  static Placement anywhere(const Header& header, const Limits& limits);
  /// All limits.
  static Limits known_limits(const Header&, const Limits& limits) { return limits; }
  static constexpr int numbers(Fields given) {
    return kDof * (given & kEffortField         ? 4
                   : given & kAccelerationField ? 3
                   : given & kVelocityField     ? 2
                                                : 1);
  }
  static Point only(Fields given, const double* numbers);
  static Point placed(const Point& given, const Placement& placement);
  static Point without_held(const Point& reference, const Placement& placement) {
    return placed(reference, placement);
  }
  static Extent placed(const Extent& given, const Placement&) { return given; }
  static Verdict judge_placed(const Extent&, const Placement&, const Limits&) { return {}; }

  static Rates secant(const Point& from, const Point& to, double T) { return (to.q - from.q) / T; }
  static Rates& rates(Point& point) { return point.dq; }
  static const Rates& rates(const Point& point) { return point.dq; }

  static void keep_sign(Point& /*point*/, const Point& /*before*/) {}
  static Difference difference(const Point& a, const Point& b);
  static Point sum(const Point& b, const Difference& difference);
  static Error error(const Point& desired, const Point& actual);

  static Effort effort_beyond(const Point& a, const Point& b) { return {a.tau - b.tau}; }
  static void add_effort(Point& point, const Effort& effort, double left, double /*rate*/) {
    point.tau += left * effort.tau;
  }

  static Point approach(const Point& reference, Difference& offset, const Point& base,
                        const Point& next, bool steps, const Limits& limits, double dt_s);
  static bool can_stop(const Point& reference, const Limits& limits, double dt_s);
  /// The part of a point that position ranges bound.
  using Place = JointVector;
  static const Place& place(const Point& point) { return point.q; }
  /// Returns the limits with a range of positions that is no wider than from `lowest` to `highest`.
  /// [cyclic]
  static Limits narrowed(const Limits& limits, const Place& lowest, const Place& highest) {
    Limits narrow = limits;
    narrow.q_min = limits.q_min.cwiseMax(lowest);
    narrow.q_max = limits.q_max.cwiseMin(highest);
    return narrow;
  }
  /// Every joint takes its own fastest way.
  static Point come_to_rest(const Point& reference, const Limits& limits, double dt_s);
  static Point rest_of(const Point& reference, const Limits& limits);
  /// Every joint takes its own shortest way to its velocity.
  static Point go_at(const Point& reference, const Rates& rates, const Limits& limits,
                     double acceleration, double jerk, double dt_s);
  /// Joints have no axes of the tip.
  static Rates in_base(const Rates& rates, const Point&) { return rates; }
};
static_assert(SpaceContract<JointSpace>());

}  // namespace tactus
