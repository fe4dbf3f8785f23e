#include "gateway/ctl/retime/corner_path.hpp"

#include <algorithm>

namespace tactus::ctl {
namespace {

constexpr double kTurnsBack = -0.9;   // cosine between the directions: 2.7 rad
constexpr double kStraightOn = 1e-9;  // negligible change of direction
constexpr double kShortest = 1e-9;    // waypoints nearer than this are the same
constexpr double kPeak = 3.0 / 16.0;  // distance of a blend from its corner, by L |d2 - d1|
/// Share of a tolerance that blends use. The rest covers coinciding waypoints, and polynomials that
/// have no waypoint where the blend is farthest from its corner.
constexpr double kUsed = 0.99;

struct Line {
  Chart chart;  // at its first waypoint
  Numbers direction;
  double length = 0.0;
  double begin = 0.0, end = 0.0;    // of what the blends leave
  std::size_t first = 0, last = 0;  // waypoints at its ends
};

std::vector<Line> lines_through(const std::vector<Numbers>& waypoints, bool tip) {
  std::vector<Line> lines;
  for (std::size_t i = 1, last = 0; i < waypoints.size(); ++i) {
    const Chart chart(waypoints[last], tip);
    const Numbers way = chart.to(waypoints[i]);
    const double length = way.matrix().norm();
    if (!(length > kShortest)) continue;
    lines.push_back({chart, way / length, length, 0.0, length, last, i});
    last = i;
  }
  return lines;
}

/// Returns L of the corner between two lines; 0: the path stops there.
double blend_length(const Line& before, const Line& after, const Corners& corners) {
  const double cosine = (before.direction * after.direction).sum();
  const Eigen::Index channels = corners.tolerance.size();
  if (cosine < kTurnsBack || (channels == 0 && !(corners.radius > 0.0))) return 0.0;
  double length = std::min(before.length, after.length) / 2.0;
  if (corners.radius > 0.0) length = std::min(length, corners.radius);
  if (channels == 0) return length;
  const Numbers turns = lengths(after.direction - before.direction, channels);
  for (Eigen::Index k = 0; k < channels; ++k)
    if (turns[k] > kStraightOn)
      length = std::min(length, kUsed * corners.tolerance[k] / (kPeak * turns[k]));
  return length;
}

}  // namespace

PathPlace PathPiece::at(double s) const {
  const double u = s / length;
  const Numbers turn = d2 - d1;
  return chart.from({start + length * (d1 * u + turn * (u * u * u * (1.0 - u / 2.0))),
                     d1 + turn * (u * u * (3.0 - 2.0 * u)), turn * (6.0 * u * (1.0 - u) / length),
                     turn * (6.0 * (1.0 - 2.0 * u) / (length * length))});
}

std::vector<PathSection> blend(const std::vector<Numbers>& waypoints, bool tip,
                               const Corners& corners) {
  std::vector<Line> lines = lines_through(waypoints, tip);
  std::vector<PathSection> sections;
  if (lines.empty()) return sections;
  sections.push_back({lines.front().first, 0, {}});
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Line& line = lines[i];
    const Numbers& direction = line.direction;
    const bool last = i + 1 == lines.size();
    const double cut = last ? 0.0 : blend_length(line, lines[i + 1], corners);
    line.end = line.length - cut;
    if (line.end - line.begin > kShortest)
      sections.back().pieces.push_back(
          {line.end - line.begin, line.chart, line.begin * direction, direction, direction, 0});
    sections.back().last = line.last;
    if (last) break;
    if (cut > 0.0) {
      Line& next = lines[i + 1];
      next.begin = cut;
      sections.back().pieces.push_back(
          {2.0 * cut, next.chart, -cut * direction, direction, next.direction, line.last});
    } else {
      sections.push_back({line.last, 0, {}});
    }
  }
  return sections;
}

}  // namespace tactus::ctl
