#include "gateway/ctl/retime/reachability.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/ctl/retime/half_planes.hpp"

namespace tactus::ctl {
namespace {

constexpr int kStepsOfBlend = 100;

/// Path derivatives at a node.
struct Slopes {
  Joints d1, d2;
  double x_max = 0.0;
};

Slopes slopes_at(const PathNode& node, const MotionBounds& bounds) {
  const PathPlace place = node.piece->at(node.offset);
  const double by_v = (place.dq.abs() / bounds.v).maxCoeff();
  const double by_j = std::cbrt((place.dddq.abs() / bounds.j).maxCoeff());
  const double speed = 1.0 / std::max(by_v, by_j);
  return {place.dq, place.ddq, speed * speed};
}

std::vector<PathNode> grid(const PathSection& section, int steps) {
  double length = 0.0;
  for (const PathPiece& piece : section) length += piece.length;
  std::vector<PathNode> nodes;
  double begin = 0.0;
  for (const PathPiece& piece : section) {
    const double share = piece.length / length * steps;
    const int count = std::max(piece.straight() ? 2 : kStepsOfBlend, static_cast<int>(share) + 1);
    for (int i = 0; i < count; ++i) {
      const double offset = piece.length * i / count;
      nodes.push_back({&piece, offset, begin + offset});
    }
    begin += piece.length;
  }
  const PathPiece& last = section.back();
  nodes.push_back({&last, last.length, begin});
  return nodes;
}

/// Returns the largest x at a node from which one up to `next_x` can be reached.
double controllable(const Slopes& here, const Slopes& there, double step, double next_x,
                    const Joints& a) {
  const double x = here.x_max, whole = 2.0 * step;
  HalfPlanes feasible(
      {{0.0, 0.0}, {next_x / whole, 0.0}, {(next_x - x) / whole, x}, {-x / whole, x}});
  for (int k = 0; k < a.size(); ++k) {
    const double slope = there.d1[k] + whole * there.d2[k];
    for (const double sign : {1.0, -1.0}) {
      feasible.cut(sign * here.d1[k], sign * here.d2[k], a[k]);
      feasible.cut(sign * slope, sign * there.d2[k], a[k]);
    }
  }
  return std::max(0.0, feasible.largest_x());
}

/// Returns the largest u from x here to one up to `next_x`.
double largest_u(const Slopes& here, const Slopes& there, double step, double x, double next_x,
                 const Joints& a) {
  const double whole = 2.0 * step;
  double low = -x / whole, high = (next_x - x) / whole;
  const auto keep = [&](double slope, double rest, double bound) {  // |slope u + rest| <= bound
    if (slope == 0.0) return;
    const double first = (-bound - rest) / slope, second = (bound - rest) / slope;
    low = std::max(low, std::min(first, second));
    high = std::min(high, std::max(first, second));
  };
  for (int k = 0; k < a.size(); ++k) {
    keep(here.d1[k], here.d2[k] * x, a[k]);
    keep(there.d1[k] + whole * there.d2[k], there.d2[k] * x, a[k]);
  }
  return high >= low ? high : (high + low) / 2.0;  // the interval may be a point, up to rounding
}

}  // namespace

std::vector<PathNode> fastest(const PathSection& section, const MotionBounds& bounds, int steps) {
  std::vector<PathNode> nodes = grid(section, steps);
  std::vector<Slopes> slopes;
  slopes.reserve(nodes.size());
  for (const PathNode& node : nodes) slopes.push_back(slopes_at(node, bounds));
  const std::size_t last = nodes.size() - 1;
  std::vector<double> most(nodes.size(), 0.0);
  for (std::size_t i = last; i-- > 0;)
    most[i] =
        controllable(slopes[i], slopes[i + 1], nodes[i + 1].s - nodes[i].s, most[i + 1], bounds.a);
  for (std::size_t i = 0; i < last; ++i) {
    PathNode &node = nodes[i], &next = nodes[i + 1];
    const double step = next.s - node.s;
    const double u = largest_u(slopes[i], slopes[i + 1], step, node.x, most[i + 1], bounds.a);
    next.x = std::clamp(node.x + 2.0 * step * u, 0.0, most[i + 1]);
    node.u = (next.x - node.x) / (2.0 * step);
    const double speeds = std::sqrt(node.x) + std::sqrt(next.x);
    if (!(speeds > 0.0)) return {};
    next.time_s = node.time_s + 2.0 * step / speeds;
  }
  return nodes;
}

}  // namespace tactus::ctl
