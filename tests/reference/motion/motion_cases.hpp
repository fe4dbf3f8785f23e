// Random limits, points and headers of either space, and estimates of the time to connect points.
#pragma once

#include "tests/reference/motion/motion_bench.hpp"
#include "tests/reference/motion/motion_tracks.hpp"

namespace tactus {

template <class Space>
struct MotionCases;

/// Returns a share of a limit: half of the time all of it, else any share from `least` on.
inline double random_share(Dice& dice, double least) {
  return dice.chance(0.5) ? 1.0 : dice.uniform(least, 1.0);
}

template <>
struct MotionCases<JointSpace> {
  using Point = JointSpace::Point;
  using Direction = JointVector;

  static JointLimits limits(Dice& dice) {
    JointLimits limits;
    limits.dq_max *= random_share(dice, 0.2);
    limits.ddq_max *= random_share(dice, 0.3);
    limits.dddq_max *= random_share(dice, 0.03);
    if (!dice.chance(0.3)) return limits;
    const JointVector middle = middle_of_range();
    const double share = dice.uniform(0.1, 0.6);
    limits.q_min = middle + share * (limits.q_min - middle);
    limits.q_max = middle + share * (limits.q_max - middle);
    return limits;
  }
  /// Returns a point at rest within the share `reach` of the range around `from`; some joints stay
  /// where they are, some are exactly at a limit.
  static Point somewhere(Dice& dice, const JointLimits& limits, const Point& from, double reach) {
    Point point;
    for (int j = 0; j < kDof; ++j) {
      const double range = limits.q_max[j] - limits.q_min[j];
      const double to = from.q[j] + reach * range * dice.uniform(-0.5, 0.5);
      point.q[j] = std::clamp(dice.chance(0.25) ? from.q[j] : to, limits.q_min[j], limits.q_max[j]);
      if (dice.chance(0.01)) point.q[j] = dice.chance(0.5) ? limits.q_min[j] : limits.q_max[j];
    }
    return point;
  }
  /// Gives a point a motion of up to `share` of the limits.
  static void set_moving(Dice& dice, const JointLimits& limits, double share, Point& point) {
    for (int j = 0; j < kDof; ++j) {
      point.dq[j] = share * limits.dq_max[j] * dice.uniform(-1.0, 1.0);
      point.ddq[j] = share * limits.ddq_max[j] * dice.uniform(-1.0, 1.0);
    }
  }
  static void scale_rates(Point& point, double rate) {
    point.dq *= rate;
    point.ddq *= rate * rate;
  }
  static void set_feed_forward(Dice& dice, const JointLimits& limits, Point& point) {
    point.tau = 0.3 * dice.uniform(-1.0, 1.0) * limits.tau_max;
  }
  static Point displaced(Dice& dice, const Point& from, double way) {
    Point point = from;
    point.q[dice.below(kDof)] += way;
    return point;
  }
  /// Returns the point at `s` on a line from the origin, passed at ds/dt, inside the position
  /// limits.
  static Point along(const JointLimits& limits, const Point& origin, const JointVector& direction,
                     double s, double ds) {
    Point point;
    point.q = (origin.q + s * direction).cwiseMax(limits.q_min).cwiseMin(limits.q_max);
    point.dq = ds * direction;
    return point;
  }
  /// Returns a random direction whose components are at most the velocity limits.
  static JointVector direction(Dice& dice, const JointLimits& limits) {
    JointVector direction;
    for (int j = 0; j < kDof; ++j) direction[j] = dice.uniform(-1.0, 1.0) * limits.dq_max[j];
    return direction;
  }
  static JointSpace::Header header(Dice& dice) {
    return {static_cast<std::uint32_t>(dice.below(1 << kDof))};
  }
  static double range(const JointLimits& limits, int i) {
    return limits.q_max[i] - limits.q_min[i];
  }
  static void set_path_tolerance(JointSpace::Band& band, double size) {
    band.q = JointVector::Constant(size);
  }
};

template <>
struct MotionCases<TaskSpace> {
  using Point = TaskSpace::Point;
  using Direction = Vector6;

  static TaskLimits limits(Dice& dice) {
    TaskLimits limits;
    const double v = random_share(dice, 0.2), a = random_share(dice, 0.3);
    const double j = random_share(dice, 0.03), turn = random_share(dice, 0.3);
    limits.v_max *= v;
    limits.a_max *= a;
    limits.j_max *= j;
    limits.w_max *= turn * v;
    limits.alpha_max *= turn * a;
    limits.dalpha_max *= turn * j;
    if (!dice.chance(0.3)) return limits;
    const Vector3 middle = home_point<TaskSpace>().x.p;
    const Vector3 half = Vector3::Constant(dice.uniform(0.1, 0.8));
    limits.p_min = (middle - half).cwiseMax(limits.p_min);
    limits.p_max = (middle + half).cwiseMin(limits.p_max);
    return limits;
  }
  static Point somewhere(Dice& dice, const TaskLimits& limits, const Point& from, double reach) {
    Point point;
    const Vector3 to = from.x.p + reach * dice.vector();
    point.x.p = (dice.chance(0.2) ? from.x.p : to).cwiseMax(limits.p_min).cwiseMin(limits.p_max);
    if (dice.chance(0.02)) point.x.p[0] = limits.p_max[0];
    const Vector3 turn =
        dice.chance(0.2) ? Vector3(Vector3::Zero()) : Vector3(2.0 * reach * dice.vector());
    point.x.r = (from.x.r * exp_so3(turn)).normalized();
    if (dice.chance(0.3)) point.x.r.coeffs() = -point.x.r.coeffs();
    return point;
  }
  static void set_moving(Dice& dice, const TaskLimits& limits, double share, Point& point) {
    const double s = share / 1.8;  // a cube of edge 2 / 1.8 is inside the unit sphere's bounds
    point.v.head<3>() = s * limits.v_max * dice.vector();
    point.v.tail<3>() = s * limits.w_max * dice.vector();
    point.a.head<3>() = s * limits.a_max * dice.vector();
    point.a.tail<3>() = s * limits.alpha_max * dice.vector();
  }
  static void scale_rates(Point& point, double rate) {
    point.v *= rate;
    point.a *= rate * rate;
  }
  static void set_feed_forward(Dice& dice, const TaskLimits& limits, Point& point) {
    point.h.head<3>() = 0.3 * limits.force_max * dice.vector();
  }
  static Point displaced(Dice& dice, const Point& from, double way) {
    Point point = from;
    point.x.p += way * dice.vector().normalized();
    return point;
  }
  static Point along(const TaskLimits& limits, const Point& origin, const Vector6& direction,
                     double s, double ds) {
    Point point;
    const Vector3 p = origin.x.p + s * direction.head<3>(), phi = s * direction.tail<3>();
    point.x.p = p.cwiseMax(limits.p_min).cwiseMin(limits.p_max);
    point.x.r = (exp_so3(phi) * origin.x.r).normalized();
    point.v = ds * direction;
    return point;
  }
  static Vector6 direction(Dice& dice, const TaskLimits& limits) {
    Point point;
    set_moving(dice, limits, 1.0, point);
    return point.v;
  }
  /// Returns a header with or without a motion frame, in which points are elsewhere in the base.
  static TaskSpace::Header header(Dice& dice) {
    static const Pose table = {{0.1, -0.05, 0.02}, exp_so3({0.0, 0.0, 0.3})};
    return {dice.chance(0.5) ? &table : nullptr, nullptr};
  }
  static double range(const TaskLimits& limits, int i) {
    return i == 0 ? (limits.p_max - limits.p_min).norm() : 3.2;
  }
  static void set_path_tolerance(TaskSpace::Band& band, double size) {
    band.position_m = band.angle_rad = size;
  }
};

/// Returns the seconds in which the slowest track stops from its largest velocity.
template <class Space>
double stopping_time_s(const typename Space::Limits& limits) {
  double time_s = 0.0;
  for (int i = 0; i < Tracks<Space>::kCount; ++i) {
    const TrackLimits of = Tracks<Space>::limits(limits, i);
    time_s = std::max(time_s, of.v / of.a + of.a / of.j);
  }
  return time_s;
}

/// Returns the seconds in which the slowest track crosses its range.
template <class Space>
double crossing_time_s(const typename Space::Limits& limits) {
  double time_s = 0.0;
  for (int i = 0; i < Tracks<Space>::kCount; ++i) {
    const double v = Tracks<Space>::limits(limits, i).v;
    time_s = std::max(time_s, MotionCases<Space>::range(limits, i) / v);
  }
  return time_s;
}

/// Estimates the seconds in which a quintic connects two points within limits, from the distances
/// and the changes of velocity.
template <class Space>
double connecting_time_s(const typename Space::Point& from, const typename Space::Point& to,
                         const typename Space::Limits& limits) {
  double time_s = 0.0;
  for (int i = 0; i < Tracks<Space>::kCount; ++i) {
    const TrackLimits of = Tracks<Space>::limits(limits, i);
    const Track a = Tracks<Space>::of(from, from, i), b = Tracks<Space>::of(to, from, i);
    const double way = (b.p - (of.turns ? Vector3(Vector3::Zero()) : a.p)).norm();
    time_s = std::max({time_s, 1.875 * way / of.v, std::sqrt(5.78 * way / of.a),
                       std::cbrt(60.0 * way / of.j), 1.5 * (b.v - a.v).norm() / of.a,
                       std::sqrt(6.0 * (b.v - a.v).norm() / of.j)});
  }
  return time_s;
}

}  // namespace tactus
