// The pairs of the collision check with a body that is no capsule and no full box.
#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"
#include "kernel/guard/collision.hpp"

namespace tactus {
namespace {

/// Returns the distance of a point from the segment from the origin to `tip`.
double from_segment(const Vector3& point, const Vector3& tip) {
  const double square = tip.squaredNorm();
  const double part = square > 0.0 ? std::clamp(point.dot(tip) / square, 0.0, 1.0) : 0.0;
  return (point - part * tip).norm();
}

}  // namespace

/// Takes the hull, in the flange frame, and returns the radius of the capsule around it.
double Collision::add_tool_hull(const Hull& points, double rounding, const Vector3& tip) {
  ToolHull& tool = tool_hull_.front();
  tool.placed.convex.take(points);
  tool.placed.convex.rounding = rounding;
  const Vector3 origin = dense(from_flange<Robot>(Vector3::Zero()));
  for (int i = 0; i < 3; ++i)
    tool.flange.r.col(i) = dense(from_flange<Robot>(Vector3::Unit(i))) - origin;
  tool.flange.p = dense(from_flange<Robot>(tool.placed.convex.middle));
  double radius = 0.0;
  LoopBound<Hull::kMost> all;
  for (int i = 0; i < points.count(); ++i) {
    all.tick();
    radius = std::max(radius, from_segment(points[i], tip));
  }
  return radius + rounding;
}

void Collision::place_tool(const LinkFrame& last_link) {
  ToolHull& tool = tool_hull_.front();
  tool.placed.r = last_link.r * tool.flange.r;
  tool.placed.middle = last_link.at(tool.flange.p);
}

bool Collision::is_hull(int capsule) const {
  return body_of(capsule) == kToolBody && tool_hull_.front().placed.convex.hull != nullptr;
}

bool Collision::is_convex(const Pair& pair) const {
  return is_hull(pair.second) ||
         (pair.of_box && section_->scene.boxes[pair.first]->inside != nullptr);
}

/// A ball and a rounded rod have a closed form, too: that of a box without width.
double Collision::convex_distance(const Pair& pair, double wanted) {
  const Solid moving = arm_solid(pair.second);
  if (!pair.of_box) return separation(moving, arm_solid(pair.first), wanted, directions_);
  const BoxShape& box = boxes_[pair.first];
  Solid other = {{}, box.r, box.centre};
  other.convex.half = box.half;
  if (const Convex* inside = section_->scene.boxes[pair.first]->inside) other.convex = *inside;
  if (is_hull(pair.second) || other.convex.core != Convex::Core::kBox)
    return separation(moving, other, wanted, directions_);
  const BoxShape core = {box.r, box.centre, other.convex.half};
  return separation(placed_[pair.second].capsule, core) - other.convex.rounding;
}

Solid Collision::arm_solid(int capsule) const {
  if (is_hull(capsule)) return tool_hull_.front().placed;
  const Capsule& shape = placed_[static_cast<std::size_t>(capsule)].capsule;
  Solid solid;
  solid.convex.core = Convex::Core::kSegment;
  solid.convex.half = 0.5 * (shape.b - shape.a);
  solid.convex.rounding = shape.radius;
  solid.middle = 0.5 * (shape.a + shape.b);
  return solid;
}

}  // namespace tactus
