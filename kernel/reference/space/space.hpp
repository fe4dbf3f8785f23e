// The concept Space: everything in which joint space and task space differ for admission, motions
// and reference generators, which are templates over a Space. JointSpace moves the joints,
// TaskSpace the tool tip in the base frame. SpaceContract documents their common members and checks
// them when the program is compiled; joint_space.hpp and task_space.hpp describe what is special in
// each.
//
//               position           channels                         axes of a Verdict
//   JointSpace  q, rad             one number per joint             the joint, from 0
//   TaskSpace   m and quaternion   lengths of translation and       0, 1, 2: x, y, z;
//                                  of rotation                      3, 4, 5: rotation about them
//
// In TaskSpace a Verdict on a length has axis 0 for translation and force, 3 for rotation and
// moment. Linear parts and forces come first in its vectors.
//
// A client may leave out joints, or give its references in frames of its own:
//
//   Header      The joints that a reference leaves out, or the frames it is given in. The client
//               sends it with the reference. At admission the poses of those joints and frames
//               are not fixed yet, so it judges the known_limits() of the header only.
//   Placement   The header resolved by latch(): where the joints that are left out are held, or
//               the poses of the frames in the base frame. The generator resolves it when it takes
//               a point and when it begins a trajectory. The placement of a trajectory stays the
//               same to its end; a moving frame is used as it was then.
//   Extent      The part of the position range and of the wrench limits that a path uses: the box
//               it covers, its largest force and moment. Admission collects it over all segments,
//               so that the generator, once the placement is fixed, can judge a path of any length
//               by one judge_placed().
#pragma once

#include <type_traits>
#include <utility>

#include "kernel/core/verdict.hpp"
#include "kernel/reference/space/interpolation.hpp"
#include "kernel/reference/space/peaks.hpp"

namespace tactus {

/// The members of a space, each followed by the check of its type:
/// static_assert(SpaceContract<S>()) compiles if S has them all.
template <class S>
struct SpaceContract : std::true_type {
  template <class Member, class Type>
  static constexpr bool kSame = std::is_same_v<Member, Type>;

  /// The limits that references are judged against.
  using Limits = typename S::Limits;
  /// The number of channels, and the numbers of a vector that make up one.
  static_assert(kSame<decltype(S::kChannels), const int> && S::kChannels > 0);
  static_assert(kSame<decltype(S::kChannelSize), const int> && S::kChannelSize > 0);
  /// Whether every law holds the robot at a reference that rests. An admittance does not hold the
  /// tip: it yields for as long as it is pushed.
  static_assert(kSame<decltype(S::kHeldByLaw), const bool>);
  /// Velocity, acceleration and jerk by channel, as limits or as what a segment reaches.
  using Peaks = typename S::Peaks;
  static_assert(kSame<Peaks, MotionPeaks<S::kChannels>>);
  /// One number per channel.
  using Levels = typename S::Levels;
  static_assert(kSame<Levels, decltype(Peaks::v)>);
  /// Largest distance between the reference and the start of a trajectory.
  using Tolerance = typename S::Tolerance;
  /// Largest distance between desired and measured position; 0: not checked.
  using Band = typename S::Band;
  /// A goal's band completed by the defaults (tolerance.hpp). [any]
  static_assert(kSame<decltype(Band::merged), Band(const Band&, const Band&)>);

  /// A reference: position, velocity, acceleration and feed-forward effort.
  using Point = typename S::Point;
  /// False if any number is NaN or infinite. [any]
  static_assert(kSame<decltype(&Point::finite), bool (Point::*)() const>);
  /// True if velocity and acceleration are exactly zero. [any]
  static_assert(kSame<decltype(&Point::standing), bool (Point::*)() const>);
  /// True if the feed-forward is exactly zero too. [any]
  static_assert(kSame<decltype(&Point::idle), bool (Point::*)() const>);
  /// Returns the same position at rest, without feed-forward. [any]
  static_assert(kSame<decltype(&Point::at_rest), Point (Point::*)() const>);
  /// Returns the same position at rest, with the same feed-forward. [any]
  static_assert(kSame<decltype(&Point::stopped), Point (Point::*)() const>);
  /// Returns the position and the given fields, and NaN in all others. [any]
  static_assert(kSame<decltype(&Point::as_measured), Point (Point::*)(Fields) const>);
  /// Turns a point p(s), p', p'' of a path into the reference that passes it at the rate
  /// r = ds/dt with the slope dr/dt in 1/s: `at_rate(rate, slope)`. [any]
  static_assert(kSame<decltype(&Point::at_rate), Point (Point::*)(double, double) const>);

  /// desired - actual, in every field.
  using Error = typename S::Error;
  static_assert(kSame<decltype(S::error), Error(const Point&, const Point&)>);
  /// a - b of two references: x with its derivatives dx and ddx. sum(b, difference(a, b)) is a,
  /// except for the effort, which is b's, and the sign of a quaternion. [any]
  using Difference = typename S::Difference;
  static_assert(kSame<decltype(&Difference::zero), bool (Difference::*)() const>);
  static_assert(kSame<decltype(Difference::dx), decltype(Difference::x)> &&
                kSame<decltype(Difference::ddx), decltype(Difference::x)>);
  static_assert(kSame<decltype(S::difference), Difference(const Point&, const Point&)>);
  static_assert(kSame<decltype(S::sum), Point(const Point&, const Difference&)>);
  /// The velocity of a point, and a vector of the same size. [any]
  using Rates = typename S::Rates;
  static_assert(kSame<decltype(S::rates(std::declval<Point&>())), Rates&> &&
                kSame<decltype(S::rates(std::declval<const Point&>())), const Rates&>);
  /// Returns the constant velocity that leads from one point to the other in T seconds. [any]
  static_assert(kSame<decltype(S::secant), Rates(const Point&, const Point&, double)>);
  /// Sets the sign of the point's quaternion so that it is nearer to that of the second point.
  /// [any]
  static_assert(kSame<decltype(S::keep_sign), void(Point&, const Point&)>);
  /// effort_beyond(a, b) returns the feed-forward of a minus that of b. add_effort(point, effort,
  /// left, rate) adds the share `left` of it, which changes at `rate` 1/s. [any]
  using Effort = typename S::Effort;
  static_assert(kSame<decltype(S::effort_beyond), Effort(const Point&, const Point&)>);
  static_assert(kSame<decltype(S::add_effort), void(Point&, const Effort&, double, double)>);

  /// Motion between two points in T > 0 seconds, made of the fields that both ends give; velocity
  /// and acceleration are the exact derivatives of the position, efforts are linear. [any]
  using Segment = typename S::Segment;
  static_assert(
      std::is_constructible_v<Segment, const Point&, const Point&, double, Interpolation, Fields> &&
      std::is_default_constructible_v<Segment>);
  /// Returns the point at 0 <= t <= T. [any]
  static_assert(kSame<decltype(&Segment::at), Point (Segment::*)(double) const>);
  /// Derivatives with respect to path time at t. [cyclic]
  using Local = typename S::Local;
  static_assert(kSame<decltype(&Segment::local), Local (Segment::*)(double) const>);
  static_assert(kSame<decltype(Local::d1), Rates> && kSame<decltype(Local::d2), Rates> &&
                kSame<decltype(Local::d3), Rates>);
  /// T, s. [any]
  static_assert(kSame<decltype(&Segment::duration), double (Segment::*)() const>);
  /// Returns the part that begins at `begin` and lasts `duration`, both in s. [any]
  static_assert(kSame<decltype(&Segment::part), Segment (Segment::*)(double, double) const>);
  /// Returns the beginning without the quantities that step there: velocity and acceleration of a
  /// straight line, the acceleration of a cubic. [any]
  static_assert(kSame<decltype(&Segment::corner), Point (Segment::*)() const>);

  /// Header, placement and extent are explained at the head of this file. `slowed` is true if the
  /// path exceeds a limit somewhere in its own times and passes that place more slowly.
  using Header = typename S::Header;
  using Placement = typename S::Placement;
  using Extent = typename S::Extent;
  static_assert(kSame<decltype(Extent::slowed), bool>);
  /// The extent of a path of two parts. [any]
  static_assert(kSame<decltype(Extent::largest), Extent(const Extent&, const Extent&)>);
  /// The peaks of one segment, its largest deceleration `slowing`, and its position range.
  using Measure = typename S::Measure;
  static_assert(kSame<decltype(Measure::peaks), Peaks> &&
                kSame<decltype(Measure::slowing), Levels>);

  /// Judges a waypoint by what no slower passage can repair: finite numbers, position, effort.
  /// [cyclic]
  static_assert(kSame<decltype(S::judge_waypoint), Verdict(const Point&, const Limits&)>);
  /// Moves a point that is beyond the end of a range by at most kMostSaturated to that end, without
  /// velocity to the outside. Returns kSaturated with the given value and that end, or kOk.
  /// [cyclic]
  static_assert(kSame<decltype(S::saturate), Verdict(Point&, const Limits&)>);
  /// Returns the velocity, acceleration and jerk limits. [any]
  static_assert(kSame<decltype(S::peaks), Peaks(const Limits&)>);
  /// Returns upper bounds of what a segment takes, close or exact where a coarse bound exceeds the
  /// given peaks or a position limit. [cyclic, some microseconds]
  static_assert(
      kSame<decltype(S::measure), Measure(const Segment&, const Limits&, const Peaks&, Accuracy)>);
  /// Judges the position range of a measured segment. Where `from` is outside of a limit, that is
  /// the limit: an arm that stands there is led back. [cyclic]
  static_assert(
      kSame<decltype(S::judge_room), Verdict(const Measure&, const Limits&, const Point& from)>);
  /// Judges the distance of two positions: kStartTolerance. [cyclic]
  static_assert(
      kSame<decltype(S::judge_near), Verdict(const Point&, const Point&, const Tolerance&)>);
  /// judge_step(before, after, limits, dt_s, level) judges the velocity step from the end of one
  /// segment to the beginning of the next: kVelocityStep. `level` sums up the steps and falls at
  /// the acceleration limit during the dt_s since the last one, so steps close together count as
  /// one. [cyclic]
  static_assert(kSame<decltype(S::judge_step),
                      Verdict(const Point&, const Point&, const Limits&, double, Levels&)>);
  /// judge_error(desired, measured, band, code) judges a position error; a violation has the status
  /// `code`. An error of NaN exceeds every band. [cyclic]
  static_assert(
      kSame<decltype(S::judge_error), Verdict(const Point&, const Point&, const Band&, Status)>);

  /// Returns the extent of a segment by its measure, and of a point at rest. [cyclic]
  static_assert(kSame<decltype(S::extent_of(std::declval<const Measure&>())), Extent>);
  static_assert(kSame<decltype(S::extent_of(std::declval<const Point&>())), Extent>);
  /// Resolves a header now, while the reference is the given point. [cyclic]
  static_assert(kSame<decltype(S::latch), Placement(const Header&, const Point&, const Limits&)>);
  /// Returns a placement for admission, before the true one is known. [any]
  static_assert(kSame<decltype(S::anywhere), Placement(const Header&, const Limits&)>);
  /// Returns the limits with those infinite that only the placement allows to judge. [any]
  static_assert(kSame<decltype(S::known_limits), Limits(const Header&, const Limits&)>);
  /// Returns how many numbers of a point, in the order of its members, reach to the last of the
  /// given fields; the position is always given. [any]
  static_assert(kSame<decltype(S::numbers), int(Fields)>);
  /// Returns a client's point from its numbers, with zeros in the fields that are not given; reads
  /// the numbers of the given fields only. [cyclic]
  static_assert(kSame<decltype(S::only), Point(Fields, const double*)>);
  /// Turns a client's point into a reference of all joints, or in the base frame. [cyclic]
  static_assert(
      kSame<decltype(S::placed(std::declval<const Point&>(), std::declval<const Placement&>())),
            Point>);
  /// Turns the extent of a client's points into the extent of their references. [cyclic]
  static_assert(
      kSame<decltype(S::placed(std::declval<const Extent&>(), std::declval<const Placement&>())),
            Extent>);
  /// Returns a reference whose held joints are at rest where the placement holds them. [cyclic]
  static_assert(kSame<decltype(S::without_held), Point(const Point&, const Placement&)>);
  /// Judges a placed extent against the limits that known_limits() left out. [cyclic]
  static_assert(
      kSame<decltype(S::judge_placed), Verdict(const Extent&, const Placement&, const Limits&)>);

  /// approach(reference, offset, base, next, steps, limits, dt_s) returns the reference one period
  /// ahead, on its way to a base that moves from `base` to `next` in that period; `offset` becomes
  /// its difference from `next`. A reference within all limits stays within them, except for the
  /// steps in velocity or acceleration of a base that has them (`steps`). [cyclic]
  static_assert(kSame<decltype(S::approach), Point(const Point&, Difference&, const Point&,
                                                   const Point&, bool, const Limits&, double)>);
  /// can_stop(reference, limits, dt_s) is true if the way to rest stays inside the position limits,
  /// or goes no further out than it is now, to 1e-9 (rad or m). [cyclic]
  static_assert(kSame<decltype(S::can_stop), bool(const Point&, const Limits&, double)>);
  /// come_to_rest(reference, limits, dt_s) returns the reference one period ahead on its way to
  /// rest; rest_of(reference, limits) returns where that way ends. [cyclic]
  static_assert(kSame<decltype(S::come_to_rest), Point(const Point&, const Limits&, double)>);
  static_assert(kSame<decltype(S::rest_of), Point(const Point&, const Limits&)>);
  /// go_at(reference, rates, limits, acceleration, jerk, dt_s) returns the reference one period
  /// ahead on its way to a velocity, with these shares of the acceleration and jerk limits. It
  /// brakes so as to rest inside the position limits, with more than these shares if it must.
  /// [cyclic]
  static_assert(kSame<decltype(S::go_at),
                      Point(const Point&, const Rates&, const Limits&, double, double, double)>);
  /// Turns a velocity from the axes of the tip into those of the base. [cyclic]
  static_assert(kSame<decltype(S::in_base), Rates(const Rates&, const Point&)>);
};

}  // namespace tactus
