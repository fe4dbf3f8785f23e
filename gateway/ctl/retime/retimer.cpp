#include "gateway/ctl/retime/retimer.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/ctl/retime/peaks.hpp"
#include "gateway/ctl/retime/time_law.hpp"

namespace tactus::ctl {
namespace {

/// Between waypoints. Admission asks for a sixteenth of the period, of 16 ms at most.
constexpr double kShortestSegment_s = 0.001;
constexpr int kFewestSteps = 8;
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
  const Peaks found = peaks(points, settings.tip, settings.bounds, settings.jerk);
  const double stretch = found.stretch() * (1.0 + kRounding);
  for (TimedPoint& point : points) {
    point.time_s *= stretch;
    point.dq /= stretch;
    point.ddq /= stretch * stretch;
  }
}

/// Removes inner waypoints that are too near to another; false: there are none.
bool thinned(std::vector<TimedPoint>& points) {
  const double end_s = points.back().time_s;
  std::vector<TimedPoint> apart = {points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double to_next_s =
        std::min(points[i].time_s - apart.back().time_s, end_s - points[i].time_s);
    if (to_next_s >= kShortestSegment_s) apart.push_back(points[i]);
  }
  apart.push_back(points.back());
  apart.swap(points);
  return points.size() < apart.size();
}

/// Returns the fastest motion along a section, with accelerations that step. Its waypoints are
/// those of the grid, which is made coarser until they are not too near: what is left out between
/// waypoints that are far apart costs little time.
std::vector<TimedPoint> with_steps(const PathSection& section, const RetimeSettings& settings) {
  std::vector<TimedPoint> points;
  bool crowded = true;
  for (int steps = settings.steps; crowded && steps >= kFewestSteps; steps /= 2) {
    points = at_nodes(fastest(section, settings.bounds, steps));
    if (points.empty()) return points;
    crowded = thinned(points);
    keep_bounds(points, settings);
  }
  return points;
}

/// Returns the fastest motion along a section whose acceleration does not step.
std::vector<TimedPoint> with_jerk(const PathSection& section, const RetimeSettings& settings) {
  const std::vector<PathNode> nodes = fastest(section, settings.bounds, settings.steps);
  std::vector<TimedPoint> best;
  if (nodes.empty()) return best;
  const double whole_s = (settings.bounds.a / settings.bounds.j).maxCoeff();
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

std::vector<TimedPoint> retime(const std::vector<Numbers>& waypoints,
                               const RetimeSettings& settings) {
  std::vector<TimedPoint> whole;
  for (const PathSection& section : blend(waypoints, settings.tip, settings.corners)) {
    std::vector<TimedPoint> points = (settings.jerk ? with_jerk : with_steps)(section, settings);
    if (points.empty()) return {};
    const double begin_s = whole.empty() ? 0.0 : whole.back().time_s;
    for (std::size_t i = whole.empty() ? 0 : 1; i < points.size(); ++i) {
      points[i].time_s += begin_s;
      whole.push_back(points[i]);
    }
  }
  return whole;
}

}  // namespace tactus::ctl
