// Tests the collision check among bodies that are no boxes, with a tool that is a hull: what passes
// is apart by a bracket of the true distances, and nothing is a contact that is none with the boxes
// and the capsule around them.
#include "kernel/guard/obstacle.hpp"
#include "tests/guard/arm_capsules.hpp"
#include "tests/guard/convex_oracle.hpp"
#include "tests/guard/ride.hpp"
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

/// The arm's bodies for the oracle: capsules of the links, then the gripper.
std::vector<OracleBody> arm_at(const JointVector& q) {
  const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(q));
  std::vector<OracleBody> arm;
  for (const LinkCapsule& entry : RobotCapsules::kCapsules) {
    const Capsule capsule = ArmCapsule(entry).placed(frames);
    arm.emplace_back();
    arm.back().points = {capsule.a, capsule.b};
    arm.back().rounding = capsule.radius;
  }
  FclPlace flange;
  kdl_flange(q.data(), flange.p, flange.r);
  arm.emplace_back();
  for (const auto& point : kGripper) {
    Vector3 placed(flange.p);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) placed[i] += flange.r[i][j] * point[j];
    arm.back().points.push_back(placed);
    arm.back().rounding = kRoundTool_m;
  }
  return arm;
}

/// Fails if a pair that is checked is surely nearer than the margin.
void assert_apart(const Scene& scene, const JointVector& q) {
  const std::vector<OracleBody> arm = arm_at(q);
  const double margin = scene.real.section.margin;
  for (std::size_t i = 0; i < arm.size(); ++i) {
    const int body = body_of(static_cast<int>(i));
    if (body == 0) continue;
    for (const OracleBody& other : scene.bodies)
      assert_false(bracket(arm[i], other, 60).most < margin - 1e-6);
    for (std::size_t first = 0; first < i; ++first)
      if (can_meet(static_cast<int>(first), static_cast<int>(i)))
        assert_false(bracket(arm[i], arm[first], 60).most < margin - 1e-6);
  }
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
      if (!over && k % 40 == 0) assert_apart(scene, ride.q);
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

/// At rest in random positions.
void an_arm_in_a_body_is_a_contact(void**) {
  static Scene scene;
  RandomStates states;
  int inside = 0;
  for (int i = 0; i < tries(3000, 300); ++i) {
    states.next();
    const std::vector<OracleBody> arm = arm_at(states.q);
    bool meets = false;
    for (std::size_t k = 0; k < arm.size(); ++k)
      for (const OracleBody& body : scene.bodies)
        meets = meets || (body_of(static_cast<int>(k)) > 0 &&
                          bracket(arm[k], body, 40).most < scene.real.section.margin - 1e-6);
    scene.real.start();
    const Status status = scene.real.check(states.q, JointVector::Zero());
    if (meets) ASSERT_STATUS(status, Status::kCollision);
    inside += meets;
  }
  assert_true(inside > tries(3000, 300) / 20);
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
      cmocka_unit_test(an_arm_in_a_body_is_a_contact),
      cmocka_unit_test(plates_that_are_far_away_do_not_keep_an_arm_from_being_armed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
