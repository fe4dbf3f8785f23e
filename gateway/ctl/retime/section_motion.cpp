#include "gateway/ctl/retime/section_motion.hpp"

#include <algorithm>
#include <cmath>

#include "gateway/ctl/retime/missed_corners.hpp"
#include "gateway/ctl/retime/peaks.hpp"
#include "gateway/ctl/retime/time_law.hpp"

namespace tactus::ctl {
namespace {

/// Time between waypoints. Admission requires a sixteenth of the period, of 16 ms at most.
constexpr double kShortestSegment_s = 0.001;
constexpr int kFewestSteps = 8;
constexpr double kShortestWindow_s = 0.004;  // four waypoints of 1 ms
/// Windows that are tried, each longer than the last by this factor: up to seven times the time in
/// which the acceleration reaches its bound.
constexpr int kWindows = 20;
constexpr double kNextWindow = 1.15;
constexpr double kWaypointsInWindow = 4.0;
constexpr double kRounding = 1e-9;  // of a bound

/// True if a node is redundant between its neighbours: the acceleration continues along a line.
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

/// Returns the times at which the acceleration along the path changes, or the path bends.
std::vector<double> changes(const std::vector<PathNode>& nodes) {
  std::vector<double> times_s;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!passed_over(nodes, i)) times_s.push_back(nodes[i].time_s);
  return times_s;
}

std::vector<TimedPoint> smoothed(const std::vector<PathNode>& nodes, double window_s,
                                 double longest_step_s) {
  const TimeLaw law(nodes, window_s);
  const double duration_s = law.duration_s();
  const int count = static_cast<int>(std::ceil(duration_s / longest_step_s));
  const double step_s = duration_s / count;
  const std::vector<double> changes_s = changes(nodes);
  auto change_s = changes_s.begin();
  std::vector<TimedPoint> points;
  for (int i = 0; i <= count; ++i) {
    const double time_s = duration_s * i / count;
    // Where nothing changes from the waypoint before to that behind, one polynomial is exact.
    while (*change_s < time_s - step_s - law.window_s()) ++change_s;
    if (i == 0 || i == count || *change_s <= time_s + step_s)
      points.push_back(moved(nodes, law.at(time_s), time_s));
  }
  for (TimedPoint* end : {&points.front(), &points.back()}) {
    end->dq.setZero();
    end->ddq.setZero();
  }
  return points;
}

/// Makes the times longer or shorter, so that every bound is just kept, and, of two waypoints that
/// alone are left, their distance.
void keep_bounds(std::vector<TimedPoint>& points, const RetimeSettings& settings) {
  const Peaks found = peaks(points, settings.tip, settings.bounds, settings.jerk);
  double stretch = found.stretch() * (1.0 + kRounding);
  if (points.size() == 2)
    stretch = std::max(stretch, kShortestSegment_s / points.back().time_s * (1.0 + kRounding));
  for (TimedPoint& point : points) {
    point.time_s *= stretch;
    point.dq /= stretch;
    point.ddq /= stretch * stretch;
  }
}

/// Removes inner waypoints that are too near to another; false: there are none. Of two, that beside
/// the longer segment stays: on a straight piece a velocity from inside of a bend would overshoot.
bool thinned(std::vector<TimedPoint>& points) {
  const double end_s = points.back().time_s;
  std::vector<TimedPoint> apart = {points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double time_s = points[i].time_s, last_s = apart.back().time_s;
    if (end_s - time_s < kShortestSegment_s) continue;
    if (time_s - last_s >= kShortestSegment_s)
      apart.push_back(points[i]);
    else if (apart.size() > 1 &&
             points[i + 1].time_s - time_s > last_s - apart[apart.size() - 2].time_s)
      apart.back() = points[i];
  }
  apart.push_back(points.back());
  apart.swap(points);
  return points.size() < apart.size();
}

bool shorter(const std::vector<TimedPoint>& points, const std::vector<TimedPoint>& than) {
  return than.empty() || points.back().time_s < than.back().time_s;
}

/// Keeps a motion if it is faster than what is kept. Returns false if it misses a corner and would
/// be the fastest of those that miss none.
bool keep(const std::vector<TimedPoint>& points, const PathSection& section,
          const RetimeSettings& settings, SectionMotions& fastest) {
  if (shorter(points, fastest.shortest)) fastest.shortest = points;
  if (!shorter(points, fastest.near)) return true;
  if (!missed_corners(section, points, settings).empty()) return false;
  fastest.near = points;
  return true;
}

/// Returns the fastest motion along a section, with accelerations that step. Its waypoints are
/// those of the grid, which is made coarser until they are not too near: what is left out between
/// waypoints that are far apart costs little time.
SectionMotions with_steps(const PathSection& section, const RetimeSettings& settings) {
  SectionMotions fastest;
  bool crowded = true;
  for (int steps = settings.steps; crowded && steps >= kFewestSteps; steps /= 2) {
    std::vector<TimedPoint> points = at_nodes(time_optimal(section, settings.bounds, steps));
    if (points.empty()) break;
    crowded = false;
    keep_bounds(points, settings);
    while (thinned(points)) {
      crowded = true;
      keep_bounds(points, settings);
    }
    keep(points, section, settings, fastest);
  }
  return fastest;
}

/// Returns the fastest motion along a section whose acceleration does not step.
SectionMotions with_jerk(const PathSection& section, const RetimeSettings& settings) {
  const std::vector<PathNode> nodes = time_optimal(section, settings.bounds, settings.steps);
  if (nodes.empty()) return {};
  SectionMotions fastest;
  const double whole_s = (settings.bounds.a / settings.bounds.j).maxCoeff();
  double window_s = std::max(kShortestWindow_s, 0.5 * whole_s);
  for (int i = 0; i < kWindows; ++i) {
    // Rows that are nearer follow the path more closely.
    bool near = false;
    for (double step_s = window_s / kWaypointsInWindow; !near && step_s >= kShortestSegment_s;
         step_s /= 2.0) {
      std::vector<TimedPoint> points = smoothed(nodes, window_s, step_s);
      keep_bounds(points, settings);
      near = keep(points, section, settings, fastest);
    }
    window_s *= kNextWindow;
  }
  return fastest;
}

}  // namespace

SectionMotions fastest_motions(const PathSection& section, const RetimeSettings& settings) {
  return settings.jerk ? with_jerk(section, settings) : with_steps(section, settings);
}

}  // namespace tactus::ctl
