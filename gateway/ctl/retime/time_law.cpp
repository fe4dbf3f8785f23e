#include "gateway/ctl/retime/time_law.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::ctl {
namespace {

constexpr double kSecondBox = 0.25;  // by the width of the first

/// Returns the node that begins the interval with a time or a path parameter in it.
template <class Member>
const PathNode& before(const std::vector<PathNode>& nodes, double value, Member member) {
  const auto next = std::upper_bound(
      nodes.begin(), nodes.end(), value,
      [member](double wanted, const PathNode& node) { return wanted < node.*member; });
  return next == nodes.begin() ? nodes.front() : *(next - 1);
}

}  // namespace

TimeLaw::TimeLaw(const std::vector<PathNode>& nodes, double smoothing_s)
    : nodes_(nodes),
      flat_s_(smoothing_s * (1.0 - kSecondBox) / 2.0),
      reach_s_(smoothing_s * (1.0 + kSecondBox) / 2.0) {}

Progress TimeLaw::fastest(double time_s) const {
  if (time_s <= 0.0) return {};
  if (time_s >= nodes_.back().time_s) return {nodes_.back().s, 0.0, 0.0};
  const PathNode& node = before(nodes_, time_s, &PathNode::time_s);
  const double t = time_s - node.time_s, speed = std::sqrt(node.x);
  return {node.s + t * (speed + t * node.u / 2.0), speed + t * node.u, node.u};
}

double TimeLaw::weight(double lag_s) const {
  const double slope_s = reach_s_ - flat_s_, top = 1.0 / (reach_s_ + flat_s_);
  return top * std::clamp((reach_s_ - std::abs(lag_s)) / slope_s, 0.0, 1.0);
}

Progress TimeLaw::at(double time_s) const {
  if (!(reach_s_ > 0.0)) return fastest(time_s);
  const double middle_s = time_s - reach_s_, begin_s = middle_s - reach_s_;
  std::vector<double> cuts = {begin_s, middle_s - flat_s_, middle_s + flat_s_, middle_s + reach_s_};
  const auto node_in_window = [this](double at_s) {
    return std::upper_bound(nodes_.begin(), nodes_.end(), at_s,
                            [](double t, const PathNode& node) { return t < node.time_s; });
  };
  for (auto node = node_in_window(begin_s); node != node_in_window(middle_s + reach_s_); ++node)
    cuts.push_back(node->time_s);
  std::sort(cuts.begin(), cuts.end());
  const Progress origin = fastest(middle_s);
  Progress mean = {origin.s, 0.0, 0.0};
  // Between two cuts s(t) is a parabola and the weight linear: Gauss's rule of two points is exact.
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double half = (cuts[i] - cuts[i - 1]) / 2.0, centre = (cuts[i] + cuts[i - 1]) / 2.0;
    for (const double place : {-1.0, 1.0}) {
      const double t = centre + place * half / std::sqrt(3.0);
      const Progress there = fastest(t);
      const double share = half * weight(t - middle_s);
      mean.s += share * (there.s - origin.s);
      mean.ds += share * there.ds;
      mean.dds += share * there.dds;
    }
  }
  return mean;
}

TimedPoint moved(const std::vector<PathNode>& nodes, const Progress& progress, double time_s) {
  const double s = std::clamp(progress.s, 0.0, nodes.back().s);
  const PathNode& node = before(nodes, s, &PathNode::s);
  const PathPlace place = node.piece->at(node.offset + s - node.s);
  return {time_s, place.q, place.dq * progress.ds,
          place.dq * progress.dds + place.ddq * (progress.ds * progress.ds), s};
}

}  // namespace tactus::ctl
