// The bench of the collision check's tests: a scene of two boxes for the kernel, and the same scene
// for the oracles, with link poses by KDL, published capsules and distances by FCL.
#pragma once

#include <algorithm>

#include "kernel/guard/collision.hpp"
#include "tests/oracles/kdl.hpp"
#include "tests/oracles/published.hpp"

namespace tactus {

/// The nearest pair of bodies that is checked.
struct Nearest {
  double distance = 1e9;  // m
  int first = 0, second = 0;
};

struct CollisionBench {
  static constexpr double kPeriod_s = 0.001;
  static constexpr int kBoxes = 2;
  Vector3 tip = {0.03, -0.02, 0.12};
  Vector3 gravity = {0.0, 0.0, -kGravity_m_s2};
  std::array<Cuboid, kBoxes> boxes;
  CollisionSection section;
  JointLimits limits;
  Collision collision;

  /// A table in front of the arm, and a tilted beam to its side.
  CollisionBench() {
    boxes[0].pose.p = {0.55, 0.0, -0.02};
    boxes[0].size = {0.5, 0.8, 0.1};
    boxes[1].pose = {{-0.2, 0.5, 0.6}, Eigen::Quaterniond(0.8, 0.3, -0.4, 0.2).normalized()};
    boxes[1].size = {0.1, 0.2, 1.2};
    add_box("table", boxes[0]);
    add_box("beam", boxes[1]);
    section.cycles = 2;
    section.lateness.setZero();
    section.overshoot.setZero();
    section.compliance.setZero();
  }
  void add_box(const char* name, const Cuboid& box) {
    CollisionScene& scene = section.scene;
    scene.boxes[static_cast<std::size_t>(scene.box_count())] = &box;
    scene.names[static_cast<std::size_t>(scene.body_count++)] = name;
  }
  void allow(int first, int second) {
    auto& allowed = section.scene.allowed;
    const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
    allowed[a][b] = allowed[b][a] = true;
  }
  void start(const JointVector* reference = nullptr) {
    collision.start(section, limits, tip, kPeriod_s, reference);
  }
  Status check(const JointVector& q, const JointVector& dq) {
    return collision.check(at(q, dq), gravity);
  }
  Status step(const JointVector& q, const JointVector& dq) { return collision.step(at(q, dq)); }
  int body(const char* name) const {
    for (int i = 0; i < section.scene.body_count; ++i)
      if (section.scene.names[static_cast<std::size_t>(i)] == name) return i;
    return -1;
  }

  /// Distance between two bodies by the oracles, m.
  double between(const JointVector& q, int first, int second) const {
    return distance(places(q), q, first, second);
  }
  /// The nearest of all checked pairs by the oracles.
  Nearest nearest(const JointVector& q) const {
    const Places links = places(q);
    Nearest result;
    for (int i = 1; i <= kToolBody; ++i)
      for (int j = 0; j < section.scene.body_count; ++j)
        if (is_checked(j, i)) take_nearer(result, links, q, j, i);
    return result;
  }

 private:
  static RobotState at(const JointVector& q, const JointVector& dq) {
    RobotState state;
    state.q = q;
    state.dq = dq;
    return state;
  }

  using Places = std::array<FclPlace, kDof + 1>;

  static Places places(const JointVector& q) {
    Places links;
    for (int i = 0; i <= kDof; ++i) {
      FclPlace& at = links[static_cast<std::size_t>(i)];
      kdl_link(q.data(), i, at.p, at.r);
    }
    return links;
  }
  bool is_checked(int first, int second) const {
    const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
    if (section.scene.allowed[a][b]) return false;
    if (first >= kFirstBoxBody) return true;
    for (const LinkPair& pair : RobotCapsules::kTouching)
      if (pair.first == first && pair.second == second) return false;
    return first < second - 1;
  }
  void take_nearer(Nearest& result, const Places& links, const JointVector& q, int first,
                   int second) const {
    const double d = distance(links, q, first, second);
    if (d < result.distance) result = {d, first, second};
  }
  /// Calls `use` with every capsule of a body and its place.
  template <class Use>
  void each_capsule(const Places& links, const JointVector& q, int body, Use use) const {
    for (const PublishedCapsule& capsule : published().capsules)
      if (capsule.link == body) use(capsule.shape, links[static_cast<std::size_t>(body)]);
    if (body != kToolBody) return;
    FclPlace flange;
    kdl_flange(q.data(), flange.p, flange.r);
    const Vector3 half = 0.5 * tip;
    use(FclCapsule{{half.x(), half.y(), half.z()},
                   {tip.x(), tip.y(), tip.z()},
                   section.tool_radius,
                   tip.norm()},
        flange);
  }
  double distance(const Places& links, const JointVector& q, int first, int second) const {
    double least = 1e9;
    each_capsule(links, q, second, [&](const FclCapsule& one, const FclPlace& at) {
      if (first >= kFirstBoxBody) {
        const Cuboid& cuboid = boxes[static_cast<std::size_t>(first - kFirstBoxBody)];
        FclPlace place;
        const Matrix3 r = cuboid.pose.r.toRotationMatrix();
        for (int i = 0; i < 3; ++i) {
          place.p[i] = cuboid.pose.p[i];
          for (int j = 0; j < 3; ++j) place.r[i][j] = r(i, j);
        }
        const FclBox box = {{cuboid.size[0], cuboid.size[1], cuboid.size[2]}};
        least = std::min(least, fcl_distance(one, at, box, place));
      } else {
        each_capsule(links, q, first, [&](const FclCapsule& other, const FclPlace& other_at) {
          least = std::min(least, fcl_distance(one, at, other, other_at));
        });
      }
    });
    return least;
  }
};

}  // namespace tactus
