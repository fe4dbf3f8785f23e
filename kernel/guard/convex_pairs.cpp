// The pairs of the collision check with a body that is no capsule and no full box.
#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"
#include "kernel/guard/collision.hpp"

namespace tactus {

/// Takes the bodies of the arm that the file gives points of.
void Collision::add_hulls(const CollisionSection& section) {
  hull_count_ = 0;
  for (int link = 0; link <= kDof; ++link)
    add_hull(link, section.link_points[link], section.link_rounding, LinkFrame());
  LinkFrame flange;
  flange.p = dense(from_flange<Robot>(Vector3::Zero()));
  for (int i = 0; i < 3; ++i)
    flange.r.col(i) = dense(from_flange<Robot>(Vector3::Unit(i))) - flange.p;
  add_hull(kToolBody, section.tool_points, section.tool_radius, flange);
}

/// The points are in the frame with these axes, of the link that the body moves with.
void Collision::add_hull(int body, const Hull& points, double rounding, const LinkFrame& axes) {
  if (points.count() == 0) return;
  ArmHull& hull = hulls_[static_cast<std::size_t>(hull_count_++)];
  hull.body = body;
  hull.placed.convex.take(points);
  hull.placed.convex.rounding = rounding;
  hull.in_link = {axes.r, axes.at(hull.placed.convex.middle)};
}

void Collision::place_hulls(const LinkFrames<Robot>& frames) {
  LoopBound<kMostHulls> hulls;
  for (int i = 0; i < hull_count_; ++i) {
    hulls.tick();
    ArmHull& hull = hulls_[static_cast<std::size_t>(i)];
    const LinkFrame& link = frames[static_cast<std::size_t>(std::min(hull.body, kDof))];
    hull.placed.r = link.r * hull.in_link.r;
    hull.placed.middle = link.at(hull.in_link.p);
  }
}

/// Returns the hull of the body that a capsule encloses, or null.
const Solid* Collision::hull_of(int capsule) const {
  LoopBound<kMostHulls> hulls;
  for (int i = 0; i < hull_count_; ++i) {
    hulls.tick();
    const ArmHull& hull = hulls_[static_cast<std::size_t>(i)];
    if (hull.body == body_of(capsule)) return &hull.placed;
  }
  return nullptr;
}

bool Collision::is_convex(const Pair& pair) const {
  if (hull_of(pair.second) != nullptr) return true;
  return pair.of_box ? section_->scene.boxes[pair.first]->inside != nullptr
                     : hull_of(pair.first) != nullptr;
}

/// A ball and a rounded rod have a closed form, too: that of a box without width.
double Collision::convex_distance(const Pair& pair, double wanted) {
  const Solid moving = arm_solid(pair.second);
  if (!pair.of_box) return separation(moving, arm_solid(pair.first), wanted, directions_);
  const BoxShape& box = boxes_[pair.first];
  Solid other = {{}, box.r, box.centre};
  other.convex.half = box.half;
  if (const Convex* inside = section_->scene.boxes[pair.first]->inside) other.convex = *inside;
  if (hull_of(pair.second) != nullptr || other.convex.core != Convex::Core::kBox)
    return separation(moving, other, wanted, directions_);
  const BoxShape core = {box.r, box.centre, other.convex.half};
  return separation(placed_[pair.second].capsule, core) - other.convex.rounding;
}

Solid Collision::arm_solid(int capsule) const {
  if (const Solid* hull = hull_of(capsule)) return *hull;
  const Capsule& shape = placed_[static_cast<std::size_t>(capsule)].capsule;
  Solid solid;
  solid.convex.core = Convex::Core::kSegment;
  solid.convex.half = 0.5 * (shape.b - shape.a);
  solid.convex.rounding = shape.radius;
  solid.middle = 0.5 * (shape.a + shape.b);
  return solid;
}

}  // namespace tactus
