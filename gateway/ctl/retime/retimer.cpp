#include "gateway/ctl/retime/retimer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gateway/ctl/retime/peaks.hpp"
#include "gateway/ctl/retime/time_law.hpp"

namespace tactus::ctl {
namespace {

constexpr double kShortestWindow_s = 0.004;  // four waypoints of 1 ms
/// Windows that are tried, each longer than the last by this factor: up to seven times the time in
/// which the acceleration reaches its bound.
constexpr int kWindows = 20;
constexpr double kNextWindow = 1.15;
constexpr double kWaypointsInWindow = 4.0;
constexpr double kRounding = 1e-9;  // of a bound

/// True if a node says nothing that its neighbours do not: the acceleration goes on along a line.
bool passed_over(const std::vector<PathNode>& nodes, std::size_t i) {
  if (i == 0 || i + 1 == nodes.size()) return false;
  const PathNode &last = nodes[i - 1], &node = nodes[i];
  return node.piece == last.piece && node.piece->straight() &&
         std::abs(node.u - last.u) <= 1e-7 * (std::abs(node.u) + std::abs(last.u));
}

std::vector<TimedPoint> at_nodes(const std::vector<PathNode>& nodes) {
  std::vector<TimedPoint> points;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const PathNode& node = nodes[i];
    if (!passed_over(nodes, i))
      points.push_back(moved(nodes, {node.s, std::sqrt(node.x), node.u}, node.time_s));
  }
  return points;
}

std::vector<TimedPoint> smoothed(const std::vector<PathNode>& nodes, double window_s) {
  const TimeLaw law(nodes, window_s);
  const double duration_s = law.duration_s();
  const int count = static_cast<int>(std::ceil(duration_s / (window_s / kWaypointsInWindow)));
  std::vector<TimedPoint> points;
  for (int i = 0; i <= count; ++i) {
    const double time_s = duration_s * i / count;
    points.push_back(moved(nodes, law.at(time_s), time_s));
  }
  for (TimedPoint* end : {&points.front(), &points.back()}) {
    end->dq.setZero();
    end->ddq.setZero();
  }
  return points;
}

/// Makes the times longer, so that every bound is kept.
void keep_bounds(std::vector<TimedPoint>& points, const RetimeSettings& settings) {
  const Peaks found = peaks(points, settings.bounds, settings.jerk);
  const double stretch = found.stretch(0.0) * (1.0 + kRounding);
  for (TimedPoint& point : points) {
    point.time_s *= stretch;
    point.dq /= stretch;
    point.ddq /= stretch * stretch;
  }
}

/// Returns the fastest motion along a section whose acceleration does not step.
std::vector<TimedPoint> with_jerk(const std::vector<PathNode>& nodes,
                                  const RetimeSettings& settings) {
  const MotionBounds& bounds = settings.bounds;
  const double whole_s = (bounds.a / bounds.j).maxCoeff();
  std::vector<TimedPoint> best;
  double window_s = std::max(kShortestWindow_s, 0.5 * whole_s);
  for (int i = 0; i < kWindows; ++i) {
    std::vector<TimedPoint> points = smoothed(nodes, window_s);
    keep_bounds(points, settings);
    if (best.empty() || points.back().time_s < best.back().time_s) best.swap(points);
    window_s *= kNextWindow;
  }
  return best;
}

}  // namespace

std::vector<TimedPoint> retime(const std::vector<Joints>& waypoints,
                               const RetimeSettings& settings) {
  std::vector<TimedPoint> whole;
  MotionBounds bounds = settings.bounds;
  if (!settings.jerk) bounds.j.setConstant(std::numeric_limits<double>::infinity());
  for (const PathSection& section : blend(waypoints, settings.corners)) {
    const std::vector<PathNode> nodes = fastest(section, bounds, settings.steps);
    if (nodes.empty()) return {};
    std::vector<TimedPoint> points = settings.jerk ? with_jerk(nodes, settings) : at_nodes(nodes);
    if (!settings.jerk) keep_bounds(points, settings);
    const double begin_s = whole.empty() ? 0.0 : whole.back().time_s;
    for (std::size_t i = whole.empty() ? 0 : 1; i < points.size(); ++i) {
      points[i].time_s += begin_s;
      whole.push_back(points[i]);
    }
  }
  return whole;
}

}  // namespace tactus::ctl
