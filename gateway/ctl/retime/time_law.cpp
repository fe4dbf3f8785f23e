#include "gateway/ctl/retime/time_law.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ctl {
namespace {

constexpr double kSecondBox = 0.25;  // by the width of the first

/// Returns the node that begins the interval with a path parameter in it.
const PathNode& before(const std::vector<PathNode>& nodes, double s) {
  const auto next =
      std::upper_bound(nodes.begin(), nodes.end(), s,
                       [](double wanted, const PathNode& node) { return wanted < node.s; });
  return next == nodes.begin() ? nodes.front() : *(next - 1);
}

}  // namespace

TimeLaw::TimeLaw(const std::vector<PathNode>& nodes, double smoothing_s)
    : nodes_(nodes),
      flat_s_(smoothing_s * (1.0 - kSecondBox) / 2.0),
      reach_s_(smoothing_s * (1.0 + kSecondBox) / 2.0) {}

TimeLaw::Node TimeLaw::after(double time_s) const {
  return std::upper_bound(nodes_.begin(), nodes_.end(), time_s,
                          [](double t, const PathNode& node) { return t < node.time_s; });
}

Progress TimeLaw::fastest(Node next, double time_s) const {
  if (next == nodes_.begin()) return {};
  const PathNode& node = *(next - 1);
  if (next == nodes_.end()) return {node.s, 0.0, 0.0};
  const double t = time_s - node.time_s, speed = std::sqrt(node.x);
  return {node.s + t * (speed + t * node.u / 2.0), speed + t * node.u, node.u};
}

double TimeLaw::weight(double lag_s) const {
  const double slope_s = reach_s_ - flat_s_, top = 1.0 / (reach_s_ + flat_s_);
  return top * std::clamp((reach_s_ - std::abs(lag_s)) / slope_s, 0.0, 1.0);
}

Progress TimeLaw::at(double time_s) const {
  const double middle_s = time_s - reach_s_;
  const Progress origin = fastest(after(middle_s), middle_s);
  Progress mean = {origin.s, 0.0, 0.0};
  double from_s = middle_s - reach_s_;
  Node next = after(from_s);
  // Between nodes and ends of slopes s(t) is a parabola and the weight linear: Gauss's rule of two
  // points is exact.
  for (const double end_s : {middle_s - flat_s_, middle_s + flat_s_, middle_s + reach_s_}) {
    while (from_s < end_s) {
      const bool at_node = next != nodes_.end() && next->time_s <= end_s;
      const double to_s = at_node ? next->time_s : end_s;
      const double half = (to_s - from_s) / 2.0, centre = (to_s + from_s) / 2.0;
      for (const double place : {-1.0, 1.0}) {
        const double t = centre + place * half / std::sqrt(3.0);
        const Progress there = fastest(next, t);
        const double share = half * weight(t - middle_s);
        mean.s += share * (there.s - origin.s);
        mean.ds += share * there.ds;
        mean.dds += share * there.dds;
      }
      if (at_node) ++next;
      from_s = to_s;
    }
  }
  return mean;
}

TimedPoint moved(const std::vector<PathNode>& nodes, const Progress& progress, double time_s) {
  const double s = std::clamp(progress.s, 0.0, nodes.back().s);
  const PathNode& node = before(nodes, s);
  const PathPlace place = node.piece->at(node.offset + s - node.s);
  return {time_s, place.q, place.dq * progress.ds,
          place.dq * progress.dds + place.ddq * (progress.ds * progress.ds), s};
}

}  // namespace tactus::ctl
