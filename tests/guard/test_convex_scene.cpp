// Tests the collision check among bodies that are no boxes, with a tool and links that are hulls:
// what passes is apart by a bracket of the true distances, and nothing is a contact that is none
// with the boxes and the capsules around them.
#include "kernel/guard/obstacle.hpp"
#include "tests/guard/arm_capsules.hpp"
#include "tests/guard/convex_oracle.hpp"
#include "tests/guard/ride.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr double kWedge[][3] = {{0.0, 0.0, 0.0},  {0.3, 0.0, 0.0},  {0.0, 0.3, 0.0},
                                {0.3, 0.3, 0.0},  {0.15, 0.0, 0.4}, {0.15, 0.3, 0.4},
                                {0.15, 0.15, 0.1}};
constexpr double kGripper[][3] = {{-0.1, -0.02, 0.0}, {0.1, -0.02, 0.0}, {-0.1, 0.02, 0.0},
                                  {0.1, 0.02, 0.0},   {-0.03, 0.0, 0.1}, {0.03, 0.0, 0.1}};

constexpr double kRoundTool_m = 0.02;

Message text_of(const double (&point)[3]) {
  Message text;
  for (const double value : point) text << value << " ";
  return text;
}

/// Points in the capsules of the links that have one, in their frames.
class Clouds {
 public:
  static constexpr int kPoints = 16;
  static constexpr double kRounding_m = 0.004;
  std::array<std::vector<Vector3>, kDof + 1> points;

  Clouds() {
    std::array<int, kDof + 1> capsules{};
    for (const LinkCapsule& entry : RobotCapsules::kCapsules) ++capsules[link_of(entry)];
    for (const LinkCapsule& entry : RobotCapsules::kCapsules)
      for (int i = 0; i < kPoints && capsules[link_of(entry)] == 1; ++i)
        points[link_of(entry)].push_back(inside(entry));
  }
  void give(CollisionSection& section) const {
    section.link_rounding = kRounding_m;
    for (std::size_t link = 0; link < points.size(); ++link)
      for (const Vector3& point : points[link]) add(section, link, point);
  }
  /// Hulls that contain the whole links, and leave their capsules.
  static void give_large(CollisionSection& section) {
    section.link_points = {};
    for (const LinkCapsule& entry : RobotCapsules::kCapsules)
      for (const auto& end : {entry.a, entry.b})
        for (int side = -1; side <= 1; side += 2)
          for (int i = 0; i < 3; ++i)
            add(section, link_of(entry),
                Vector3(end) + 2.0 * entry.radius * side * Vector3::Unit(i));
  }
  static std::size_t link_of(const LinkCapsule& entry) {
    return static_cast<std::size_t>(entry.link);
  }

 private:
  Random random_{17};

  static void add(CollisionSection& section, std::size_t link, const Vector3& point) {
    Message text(RobotCapsules::kLinkNames[link]), why;
    text << " " << point.x() << " " << point.y() << " " << point.z();
    ASSERT_OK(section.link_points.add(text, 1, why));
  }

  Vector3 inside(const LinkCapsule& entry) {
    const Vector3 a(entry.a[0], entry.a[1], entry.a[2]), b(entry.b[0], entry.b[1], entry.b[2]);
    Vector3 out;
    do out = {random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0), random_.uniform(-1.0, 1.0)};
    while (out.norm() > 1.0);
    return a + random_.uniform(0.0, 1.0) * (b - a) + (entry.radius - 2.0 * kRounding_m) * out;
  }
};

const Clouds& clouds() {
  static const Clouds all;
  return all;
}

/// The scene, once with what is in the boxes and once full of boxes, with the tool's capsule.
struct Scene {
  SphereObstacle ball;
  CapsuleObstacle rail;
  CylinderObstacle drum;
  ConvexObstacle wedge;
  CollisionBench real, boxes;
  std::array<Cuboid, 4> full;
  std::vector<OracleBody> bodies;  // placed, in the order of the scene's boxes

  Scene() {
    ball.params.centre = {0.5, -0.4, 0.6};
    ball.params.form.radius = 0.15;
    rail.params.centre = {0.2, 0.6, 0.3};
    rail.params.rotation = {1.2, 0.3, 0.0};
    rail.params.form = {0.06, 0.7, {}};
    drum.params.centre = {-0.5, 0.0, 0.35};
    drum.params.rotation = {0.2, -0.1, 0.0};
    drum.params.form = {0.2, 0.5, {}};
    wedge.params.centre = {0.55, 0.05, 0.05};
    wedge.params.rotation = {0.0, 0.0, 0.4};
    wedge.params.form.rounding = 0.01;
    Message why;
    for (const auto& point : kWedge)
      ASSERT_OK(wedge.params.form.points.add(text_of(point), 1, why));
    for (const auto& point : kGripper)
      ASSERT_OK(real.section.tool_points.add(text_of(point), 1, why));
    real.section.scene.body_count = boxes.section.scene.body_count = kFirstBoxBody;
    clouds().give(real.section);
    add(ball, "ball");
    add(rail, "rail");
    add(drum, "drum");
    add(wedge, "wedge");
    real.section.tool_radius = kRoundTool_m;
    boxes.section.tool_radius =
        0.12;  // the gripper's points are nearer to the line from flange to tip
    describe();
  }

 private:
  template <class Body>
  void add(Body& body, const char* name) {
    ASSERT_OK(body.start());
    real.add_box(name, body.box.value);
    Cuboid& box = full[bodies.size()];
    box = body.box.value;
    box.inside = nullptr;
    boxes.add_box(name, box);
    bodies.emplace_back();
  }
  /// The bodies for the oracle, from what the file would say.
  void describe() {
    const auto at = [](const auto& of, const Vector3& point) -> Vector3 {
      return of.params.centre + exp_so3(of.params.rotation) * point;
    };
    bodies[0].points = {ball.params.centre};
    bodies[0].rounding = 0.15;
    bodies[1].points = {at(rail, {0.0, 0.0, 0.35}), at(rail, {0.0, 0.0, -0.35})};
    bodies[1].rounding = 0.06;
    bodies[2].points = {at(drum, {0.0, 0.0, 0.25}), at(drum, {0.0, 0.0, -0.25})};
    bodies[2].radius = 0.2;
    bodies[2].normal = exp_so3(drum.params.rotation) * Vector3::UnitZ();
    for (const auto& point : kWedge) bodies[3].points.push_back(at(wedge, Vector3(point)));
    bodies[3].rounding = 0.01;
  }
};

Vector3 placed(const Vector3& point, const FclPlace& at) {
  Vector3 result(at.p);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i] += at.r[i][j] * point[j];
  return result;
}

/// The arm's bodies for the oracle: links, as capsules or clouds, then the gripper.
std::vector<OracleBody> arm_at(const JointVector& q) {
  std::vector<OracleBody> arm;
  FclPlace at;
  for (const LinkCapsule& entry : RobotCapsules::kCapsules) {
    kdl_link(q.data(), entry.link, at.p, at.r);
    arm.emplace_back();
    arm.back().rounding = Clouds::kRounding_m;
    for (const Vector3& point : clouds().points[Clouds::link_of(entry)])
      arm.back().points.push_back(placed(point, at));
    if (!arm.back().points.empty()) continue;
    arm.back().rounding = entry.radius;
    arm.back().points = {placed(Vector3(entry.a), at), placed(Vector3(entry.b), at)};
  }
  kdl_flange(q.data(), at.p, at.r);
  arm.emplace_back();
  arm.back().rounding = kRoundTool_m;
  for (const auto& point : kGripper) arm.back().points.push_back(placed(Vector3(point), at));
  return arm;
}

/// The smallest distance of all pairs that are checked.
Bracket nearest(const Scene& scene, const JointVector& q, int steps) {
  const std::vector<OracleBody> arm = arm_at(q);
  Bracket nearest = {1e9, 1e9};
  const auto take = [&](const OracleBody& one, const OracleBody& other) {
    const Bracket pair = bracket(one, other, steps);
    nearest = {std::min(nearest.least, pair.least), std::min(nearest.most, pair.most)};
  };
  for (int i = 0; i < kArmCapsules; ++i) {
    const OracleBody& moving = arm[static_cast<std::size_t>(i)];
    for (const OracleBody& body : scene.bodies)
      if (body_of(i) > 0) take(moving, body);
    for (int first = 0; first < i; ++first)
      if (can_meet(first, i)) take(moving, arm[static_cast<std::size_t>(first)]);
  }
  return nearest;
}

// Proves COL-12.

void what_passes_is_apart_and_a_contact_is_one_of_the_boxes_too(void**) {
  static Scene scene;
  Ride ride;
  int contacts = 0, of_boxes = 0, looked_at = 0;
  const int rides = trials(tries(60, 8));
  for (int i = 0; i < rides; ++i) {
    ride.begin();
    scene.real.start();
    scene.boxes.start();
    bool over = false, over_boxes = false;
    for (int k = 0; k < 800 && !over; ++k) {
      over_boxes = over_boxes || scene.boxes.step(ride.q, ride.dq) != Status::kOk;
      over = scene.real.step(ride.q, ride.dq) != Status::kOk;
      assert_false(scene.real.collision.telemetry().unproved);
      if (over) assert_true(over_boxes);
      if (!over && k % 40 == 0)
        assert_false(nearest(scene, ride.q, 60).most < scene.real.section.margin - 1e-6);
      looked_at += !over && k % 40 == 0;
      ride.advance(scene.real.limits);
    }
    contacts += over;
    of_boxes += over_boxes;
  }
  print_message("%d motions, %d contacts, %d with boxes, %d positions looked at\n", rides, contacts,
                of_boxes, looked_at);
  assert_true(contacts > rides / 10 && contacts < of_boxes && looked_at > rides);
}

/// At rest in random positions, with so little acceleration that the way until rest is short.
void an_arm_at_rest_is_in_contact_where_its_bodies_are(void**) {
  static Scene scene, with_capsules, with_large;
  with_capsules.real.section.link_points = {};
  Clouds::give_large(with_large.real.section);
  RandomStates states;
  const int count = tries(3000, 300);
  int inside = 0, of_capsules = 0;
  for (int i = 0; i < count; ++i) {
    states.next();
    const auto check = [&](CollisionBench& bench) {
      bench.limits.ddq_max.setConstant(0.01);
      bench.section.braking = bench.limits.ddq_max;
      bench.start();
      return bench.check(states.q, JointVector::Zero());
    };
    const Bracket distance = nearest(scene, states.q, 100);
    const double margin = scene.real.section.margin;
    const bool meet = distance.most<margin - 1e-6, apart = distance.least> margin + 2e-3;
    const Status status = check(scene.real);
    if (meet) ASSERT_STATUS(status, Status::kCollision);
    if (apart) ASSERT_OK(status);
    const bool as_capsules = check(with_capsules.real) == Status::kOk;
    if (as_capsules) ASSERT_OK(check(with_large.real));
    inside += meet;
    of_capsules += apart && !as_capsules;
  }
  print_message("of %d positions %d in contact, %d only with capsules\n", count, inside,
                of_capsules);
  assert_true(inside > count / 20 && of_capsules > count / 100);
}

/// Eight inclined plates, in whose boxes the arm is and which are far from it: it can be armed.
void plates_that_are_far_away_do_not_keep_an_arm_from_being_armed(void**) {
  static CollisionBench bench;
  static std::array<ConvexObstacle, kMaxObstacles> plates;
  Random random{8};
  bench.section.scene.body_count = kFirstBoxBody;
  const JointVector q = 0.5 * (bench.limits.q_min + bench.limits.q_max);
  std::vector<OracleBody> arm = arm_at(q);
  for (ConvexObstacle& plate : plates) {
    OracleBody body;
    const auto far = [&](const OracleBody& of) { return bracket(of, body, 100).least > 0.06; };
    do {
      plate = {};
      body.points.clear();
      Message why;
      for (int i = 0; i < 3; ++i) {
        const double corner[3] = {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0),
                                  random.uniform(-2.0, 2.0)};
        ASSERT_OK(plate.params.form.points.add(text_of(corner), 1, why));
        body.points.emplace_back(corner);
      }
    } while (!std::all_of(arm.begin(), arm.end(), far));
    ASSERT_OK(plate.start());
    bench.add_box("plate", plate.box.value);
  }
  bench.limits.ddq_max.setConstant(0.01);
  bench.start();
  ASSERT_OK(bench.check(q, JointVector::Zero()));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_passes_is_apart_and_a_contact_is_one_of_the_boxes_too),
      cmocka_unit_test(an_arm_at_rest_is_in_contact_where_its_bodies_are),
      cmocka_unit_test(plates_that_are_far_away_do_not_keep_an_arm_from_being_armed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
