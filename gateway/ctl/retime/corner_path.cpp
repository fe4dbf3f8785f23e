#include "gateway/ctl/retime/corner_path.hpp"

#include <algorithm>
#include <limits>

namespace tactus::ctl {
namespace {

constexpr double kTurnsBack = -0.9;     // cosine between the directions: 2.7 rad
constexpr double kStraightOn = 1e-9;    // change of direction that no joint notices
constexpr double kShortest_rad = 1e-9;  // waypoints nearer than this are the same
constexpr double kPeak = 3.0 / 16.0;    // distance of a blend from its corner, by L |d2 - d1|

struct Line {
  Joints start, direction;
  double length = 0.0;
  double begin = 0.0, end = 0.0;  // of what the blends leave
};

std::vector<Line> lines_through(const std::vector<Joints>& waypoints) {
  std::vector<Line> lines;
  for (std::size_t i = 1, last = 0; i < waypoints.size(); ++i) {
    const Joints way = waypoints[i] - waypoints[last];
    const double length = way.matrix().norm();
    if (!(length > kShortest_rad)) continue;
    lines.push_back({waypoints[last], way / length, length, 0.0, length});
    last = i;
  }
  return lines;
}

/// Returns L of the corner between two lines; 0: the path stops there.
double blend_length(const Line& before, const Line& after, const Corners& corners) {
  const double cosine = (before.direction * after.direction).sum();
  if (cosine < kTurnsBack) return 0.0;
  const double turn = (after.direction - before.direction).abs().maxCoeff();
  double length = std::min(before.length, after.length) / 2.0;
  if (corners.radius_rad > 0.0) length = std::min(length, corners.radius_rad);
  if (corners.tolerance_rad > 0.0)
    length = std::min(length, corners.tolerance_rad / (kPeak * std::max(turn, kStraightOn)));
  return corners.radius_rad > 0.0 || corners.tolerance_rad > 0.0 ? length : 0.0;
}

}  // namespace

PathPlace PathPiece::at(double s) const {
  const double u = s / length;
  const Joints turn = d2 - d1;
  return {start + length * (d1 * u + turn * (u * u * u * (1.0 - u / 2.0))),
          d1 + turn * (u * u * (3.0 - 2.0 * u)), turn * (6.0 * u * (1.0 - u) / length),
          turn * (6.0 * (1.0 - 2.0 * u) / (length * length))};
}

std::vector<PathSection> blend(const std::vector<Joints>& waypoints, const Corners& corners) {
  std::vector<Line> lines = lines_through(waypoints);
  std::vector<PathSection> sections;
  if (lines.empty()) return sections;
  sections.emplace_back();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Line& line = lines[i];
    const bool last = i + 1 == lines.size();
    const double cut = last ? 0.0 : blend_length(line, lines[i + 1], corners);
    line.end = line.length - cut;
    if (line.end - line.begin > kShortest_rad)
      sections.back().push_back({line.end - line.begin, line.start + line.begin * line.direction,
                                 line.direction, line.direction});
    if (last) break;
    if (cut > 0.0) {
      lines[i + 1].begin = cut;
      sections.back().push_back({2.0 * cut, line.start + line.end * line.direction, line.direction,
                                 lines[i + 1].direction});
    } else {
      sections.emplace_back();
    }
  }
  return sections;
}

}  // namespace tactus::ctl
