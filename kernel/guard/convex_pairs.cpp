// The pairs of the collision check with a body that is no capsule and no full box.
#include <algorithm>
#include <cmath>

#include "kernel/core/loop_bound.hpp"
#include "kernel/guard/collision.hpp"

namespace tactus {
namespace {

Solid solid_of(const Capsule& shape) {
  Solid solid;
  solid.convex.core = Convex::Core::kSegment;
  solid.convex.half = 0.5 * (shape.b - shape.a);
  solid.convex.rounding = shape.radius;
  solid.middle = 0.5 * (shape.a + shape.b);
  return solid;
}

Solid solid_of(const Hull& points, double rounding) {
  Solid solid;
  solid.convex.take(points);
  solid.convex.rounding = rounding;
  solid.middle = solid.convex.middle;
  return solid;
}

}  // namespace

int CollisionSection::misplaced_hull() const {
  constexpr int kEnough = 1 << 10;
  for (const LinkCapsule& capsule : RobotCapsules::kCapsules) {
    const Hull& points = link_points[capsule.link];
    if (points.count() == 0) continue;
    const Solid hull = solid_of(points, link_rounding);
    for (const auto& end : {capsule.a, capsule.b}) {
      const Vector3 point = {end[0], end[1], end[2]};
      int directions = kEnough;
      if (separation(solid_of(Capsule{point, point, capsule.radius}), hull, 0.0, directions) > 0.0)
        return capsule.link;
    }
  }
  return -1;
}

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
  hull.placed = solid_of(points, rounding);
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

/// A link with a hull counts as its capsules, too: it is in both. The tool is in its hull alone.
bool Collision::counts_as(int capsule, bool hull) const {
  const bool has_hull = hull_of(capsule) != nullptr;
  return hull ? has_hull : !has_hull || body_of(capsule) != kToolBody;
}

/// Returns the largest distance that is proved, of the bodies as capsules and as hulls. That of two
/// capsules has its closed form.
double Collision::convex_distance(const Pair& pair, double wanted) {
  double best = -kInfinity;
  LoopBound<4> ways;
  for (int way = 0; way < 4 && !(best > wanted); ++way) {
    ways.tick();
    const bool hull_moves = way % 2 == 1, hull_stays = way / 2 == 1;
    if (!counts_as(pair.second, hull_moves)) continue;
    if (pair.of_box) {
      if (!hull_stays) best = std::max(best, box_distance(pair, hull_moves, wanted));
    } else if ((hull_moves || hull_stays) && counts_as(pair.first, hull_stays)) {
      const Solid moving = arm_solid(pair.second, hull_moves);
      best = std::max(best,
                      separation(moving, arm_solid(pair.first, hull_stays), wanted, directions_));
    }
  }
  return best;
}

/// A ball and a rounded rod have a closed form, too: that of a box without width.
double Collision::box_distance(const Pair& pair, bool hull, double wanted) {
  const BoxShape& box = boxes_[pair.first];
  Solid other = {{}, box.r, box.centre};
  other.convex.half = box.half;
  if (const Convex* inside = section_->scene.boxes[pair.first]->inside) other.convex = *inside;
  if (hull || other.convex.core != Convex::Core::kBox)
    return separation(arm_solid(pair.second, hull), other, wanted, directions_);
  const BoxShape core = {box.r, box.centre, other.convex.half};
  return separation(placed_[pair.second].capsule, core) - other.convex.rounding;
}

Solid Collision::arm_solid(int capsule, bool hull) const {
  if (hull) return *hull_of(capsule);
  return solid_of(placed_[static_cast<std::size_t>(capsule)].capsule);
}

}  // namespace tactus
