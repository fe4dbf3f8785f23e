#include "gateway/ctl/retime/retimer.hpp"

#include <algorithm>

#include "gateway/ctl/retime/missed_corners.hpp"
#include "gateway/ctl/retime/peaks.hpp"

namespace tactus::ctl {
namespace {

/// Corners with at least this share of the worst corner's stretch are tried as stops together with
/// it.
constexpr double kNearlyWorst = 0.98;

using Path = std::vector<Numbers>;
using Motion = std::vector<TimedPoint>;

/// Appends what begins where the whole ends.
void append(Motion& whole, const Motion& next) {
  const double begin_s = whole.empty() ? 0.0 : whole.back().time_s;
  for (std::size_t i = whole.empty() ? 0 : 1; i < next.size(); ++i) {
    whole.push_back(next[i]);
    whole.back().time_s += begin_s;
  }
}

struct CornerStretch {
  std::size_t waypoint;
  double stretch;
};

/// Returns, for the motion halfway to the next corners, by how much each would stretch it alone; 0
/// if there is none.
std::vector<CornerStretch> corner_stretches(const PathSection& section, const Motion& motion,
                                            const RetimeSettings& settings) {
  std::vector<CornerStretch> corners;
  std::vector<double> middles;
  double s = 0.0;
  for (const PathPiece& piece : section.pieces) {
    if (piece.corner != 0) {
      corners.push_back({piece.corner, 0.0});
      middles.push_back(s + piece.length / 2.0);
    }
    s += piece.length;
  }
  if (motion.empty()) return corners;
  auto begin = motion.begin();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    auto end = begin + 1;
    const bool last = i + 1 == corners.size();
    while (end != motion.end() && (last || end->s < (middles[i] + middles[i + 1]) / 2.0)) ++end;
    const Motion around(begin, end == motion.end() ? end : end + 1);
    corners[i].stretch = peaks(around, settings.tip, settings.bounds, settings.jerk).stretch();
    begin = end == motion.end() ? end - 1 : end;
  }
  return corners;
}

/// Returns the corners of the section that are tried as stops: those that the motion misses, else
/// those that stretch it most.
std::vector<std::size_t> tried(const PathSection& section, const Motion& motion,
                               const RetimeSettings& settings) {
  std::vector<std::size_t> found = missed_corners(section, motion, settings);
  if (!found.empty()) return found;
  const std::vector<CornerStretch> corners = corner_stretches(section, motion, settings);
  double worst = 0.0;
  for (const CornerStretch& corner : corners) worst = std::max(worst, corner.stretch);
  for (const CornerStretch& corner : corners)
    if (corner.stretch >= kNearlyWorst * worst) found.push_back(corner.waypoint);
  return found;
}

Motion along(const PathSection& section, const Path& waypoints, const RetimeSettings& settings) {
  const SectionMotions fastest = fastest_motions(section, settings);
  const Motion& rounded = fastest.near;
  std::vector<std::size_t> ends = tried(section, fastest.shortest, settings);
  if (ends.empty()) return rounded;
  ends.insert(ends.begin(), section.first);
  ends.push_back(section.last);
  Motion stopping;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const auto at = [&](std::size_t k) {
      return waypoints.begin() + static_cast<std::ptrdiff_t>(ends[k]);
    };
    const Motion next = retime({at(i - 1), at(i) + 1}, settings);
    if (next.empty()) return rounded;
    append(stopping, next);
  }
  return rounded.empty() || stopping.back().time_s < rounded.back().time_s ? stopping : rounded;
}

}  // namespace

std::vector<TimedPoint> retime(const Path& waypoints, const RetimeSettings& settings) {
  Motion whole;
  for (const PathSection& section : blend(waypoints, settings.tip, settings.corners)) {
    const Motion next = along(section, waypoints, settings);
    if (next.empty()) return {};
    append(whole, next);
  }
  return whole;
}

}  // namespace tactus::ctl
