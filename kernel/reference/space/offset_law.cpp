#include "kernel/reference/space/offset_law.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {

void LineLimits::add(double way, const AxisLimits& axis) {
  const double d = std::abs(way);
  if (!(d > 0.0)) return;
  const bool up = way > 0.0;
  limits_.v_hi = std::min(limits_.v_hi, (up ? axis.v_hi : -axis.v_lo) / d);
  limits_.v_lo = std::max(limits_.v_lo, (up ? axis.v_lo : -axis.v_hi) / d);
  limits_.a_up = std::min(limits_.a_up, (up ? axis.a_up : axis.a_dn) / d);
  limits_.a_dn = std::min(limits_.a_dn, (up ? axis.a_dn : axis.a_up) / d);
  limits_.j = std::min(limits_.j, axis.j / d);
}

double left_of(double own, double taken) {
  constexpr double kLeast = 0.05;
  return std::max(own - taken, kLeast * own);
}

AxisLimits left_beside(const AxisLimits& own, const AxisState& now, const AxisState& next,
                       double dt_s) {
  const double ahead = next.v + next.a * 1.5 * std::max(own.a_dn, own.a_up) / own.j;
  const double jerk = std::abs(next.a - now.a) / dt_s;
  return {-left_of(-own.v_lo, -std::min({now.v, next.v, ahead})),
          left_of(own.v_hi, std::max({now.v, next.v, ahead})),
          left_of(own.a_dn, -std::min(now.a, next.a)), left_of(own.a_up, std::max(now.a, next.a)),
          left_of(own.j, jerk < own.j ? jerk : 0.0)};
}

}  // namespace tactus
