// Tests the rules of the collision check: which pairs are checked, and what the report contains.
#include "sim_plant/arm/plant_params.hpp"
#include "tests/guard/collision_bench.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves COL-7.

void link_frames_are_those_of_kdl(void**) {
  RandomStates states;
  for (int i = 0; i < 300; ++i) {
    states.next();
    const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(states.q));
    for (int link = 0; link <= kDof; ++link) {
      double p[3], r[3][3];
      kdl_link(states.q.data(), link, p, r);
      const LinkFrame& frame = frames[static_cast<std::size_t>(link)];
      for (int row = 0; row < 3; ++row) {
        ASSERT_NEAR(frame.p[row], p[row], 1e-14);
        for (int column = 0; column < 3; ++column)
          ASSERT_NEAR(frame.r(row, column), r[row][column], 1e-14);
      }
    }
  }
}

/// The excluded pairs touch in at least a tenth of all positions, all others in a fifth at most; in
/// between a table has the choice. In the simulated robot's start pose nothing touches.
void pairs_that_always_touch_are_those_of_the_table(void**) {
  static CollisionBench bench;
  bench.tip = {0.0, 0.0, 0.1};
  constexpr int kPositions = 300;
  for (int second = 2; second <= kToolBody; ++second) {
    for (int first = 0; first < second - 1; ++first) {
      bool listed = false;
      for (const LinkPair& pair : RobotCapsules::kTouching)
        listed = listed || (pair.first == first && pair.second == second);
      RandomStates states;
      int touching = 0;
      for (int i = 0; i < kPositions; ++i) {
        states.next();
        touching += bench.between(states.q, first, second) <= 0.0;
      }
      const auto say = [&](const char* what) {
        const auto& names = bench.section.scene.names;
        print_error("%s and %s: %s; they touch in %d of %d positions\n",
                    names[static_cast<std::size_t>(first)], names[static_cast<std::size_t>(second)],
                    what, touching, kPositions);
      };
      const bool right = listed ? touching >= kPositions / 10 : touching <= kPositions / 5;
      if (!right) say(listed ? "take them out of kTouching" : "list them in kTouching");
      assert_true(right);
      const bool apart = listed || bench.between(ready_pose(), first, second) > 0.02;
      if (!apart) say("less than 20 mm apart in the start pose");
      assert_true(apart);
    }
  }
}

void capsules_stand_in_the_order_of_their_links(void**) {
  int last = 0;
  for (const LinkCapsule& capsule : RobotCapsules::kCapsules) {
    assert_in_range(capsule.link, last, kDof);
    last = capsule.link;
  }
  for (const LinkPair& pair : RobotCapsules::kTouching)
    assert_true(pair.first + 2 <= pair.second && pair.second <= kToolBody);
}

// Proves COL-5.

/// The tip is in a box, which then may touch the tool, and then the last link too.
void an_allowed_pair_is_not_checked(void**) {
  static CollisionBench bench;
  Jacobian J;
  const Pose flange = forward_kinematics<Robot>(joint_trig<Robot>(ready_pose()), Pose(), J);
  bench.tip = {0.0, 0.0, 0.3};
  bench.boxes[0].pose.p = flange.p + flange.r * bench.tip;
  bench.boxes[0].size = Vector3::Constant(0.05);
  bench.boxes[1].pose.p = {0.0, 0.0, -3.0};
  bench.start();
  ASSERT_STATUS(bench.check(ready_pose(), JointVector::Zero()), Status::kCollision);
  assert_string_equal(bench.collision.telemetry().first, "table");
  assert_string_equal(bench.collision.telemetry().second, "tool");
  assert_false(bench.collision.telemetry().predicted);

  bench.allow(kToolBody, kFirstBoxBody);
  bench.start();
  ASSERT_OK(bench.check(ready_pose(), JointVector::Zero()));

  bench.boxes[0].pose.p = flange.p;
  ASSERT_STATUS(bench.check(ready_pose(), JointVector::Zero()), Status::kCollision);
  assert_string_not_equal(bench.collision.telemetry().second, "tool");
}

// Proves COL-1.

/// Puts a small box at the middle of every moving capsule; all other bodies may touch it.
void every_capsule_that_moves_is_checked_against_a_box(void**) {
  static CollisionBench bench;
  bench.tip = {0.0, 0.0, 0.2};
  bench.boxes[0].size = Vector3::Constant(0.01);
  bench.boxes[1].pose.p.z() = -3.0;
  const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(ready_pose()));
  const auto assert_found = [](int body, const Vector3& at) {
    bench.section.scene.allowed = {};
    for (int other = 0; other <= kToolBody; ++other)
      if (other != body) bench.allow(other, kFirstBoxBody);
    bench.boxes[0].pose.p = at;
    bench.start();
    ASSERT_STATUS(bench.check(ready_pose(), JointVector::Zero()), Status::kCollision);
    assert_string_equal(bench.collision.telemetry().first, "table");
    assert_ptr_equal(bench.collision.telemetry().second,
                     bench.section.scene.names[static_cast<std::size_t>(body)]);
  };
  for (const LinkCapsule& capsule : RobotCapsules::kCapsules) {
    const Vector3 a(capsule.a), b(capsule.b);
    if (capsule.link > 0)
      assert_found(capsule.link, frames[static_cast<std::size_t>(capsule.link)].at(0.5 * (a + b)));
  }
  assert_found(kToolBody, tip_pose(ready_pose(), Pose{0.5 * bench.tip, {1.0, 0.0, 0.0, 0.0}}).p);
}

// Proves COL-4.

void what_is_not_finite_is_no_pass(void**) {
  static CollisionBench bench;
  bench.boxes[0].pose.p.z() = bench.boxes[1].pose.p.z() = -5.0;
  ASSERT_STATUS(bench.check(ready_pose(), JointVector::Zero()), Status::kNotStarted);
  bench.start();
  ASSERT_OK(bench.check(ready_pose(), JointVector::Zero()));
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    JointVector q = ready_pose(), dq = JointVector::Zero();
    q[2] = bad;
    ASSERT_STATUS(bench.check(q, dq), Status::kStateNotFinite);
    dq[kDof - 1] = bad;
    ASSERT_STATUS(bench.check(ready_pose(), dq), Status::kStateNotFinite);
  }
  for (const double huge : {1e6, 1e100, 1e300}) {
    ASSERT_STATUS(bench.check(huge * ready_pose(), JointVector::Zero()), Status::kCollision);
    ASSERT_STATUS(bench.check(ready_pose(), JointVector::Constant(huge)), Status::kCollision);
  }
  for (JointVector* key :
       {&bench.section.lateness, &bench.section.overshoot, &bench.section.compliance})
    for (double& value : *key) {  // nobody has said it
      key->setZero();
      value = std::nan("");
      bench.start();
      ASSERT_STATUS(bench.check(ready_pose(), JointVector::Zero()), Status::kCollision);
      key->setZero();
    }
  bench.start();
  bench.boxes[1].pose.p.x() = std::nan("");
  ASSERT_STATUS(bench.check(ready_pose(), JointVector::Zero()), Status::kCollision);
  assert_string_equal(bench.collision.telemetry().first, "beam");
}

/// Height of the tip by KDL, m, and its position.
double tip_height(const CollisionBench& bench, const JointVector& q, Vector3* tip = nullptr) {
  FclPlace flange;
  kdl_flange(q.data(), flange.p, flange.r);
  Vector3 at;
  for (int i = 0; i < 3; ++i)
    at[i] = flange.p[i] + Eigen::Map<const Vector3>(flange.r[i]).dot(bench.tip);
  if (tip != nullptr) *tip = at;
  return at.z();
}

/// Where springs and the weight of the payload are in balance: the way down the potential energy in
/// small steps, with the slope by differences.
JointVector balance(const CollisionBench& bench, const JointVector& q) {
  constexpr double kStep = 0.02, kDifference = 1e-5;
  const double weight = bench.section.unknown_payload * kGravity_m_s2;
  JointVector sag = JointVector::Zero();
  for (int n = 0; n < 1000 && sag.cwiseAbs().maxCoeff() < 1.0; ++n) {
    JointVector pull;
    for (int i = 0; i < kDof; ++i) {
      const JointVector there = kDifference * JointVector::Unit(i);
      const double rise = tip_height(bench, q + sag + there) - tip_height(bench, q + sag - there);
      pull[i] = -weight * rise / (2.0 * kDifference);
    }
    sag += kStep * (bench.section.compliance.cwiseProduct(pull) - sag);
  }
  return sag;
}

// Proves COL-16.

void a_box_where_the_payload_pulls_the_tip_to_is_a_contact(void**) {
  static CollisionBench bench;
  bench.section.unknown_payload = 3.0;
  RandomStates states;
  int far = 0;
  for (int n = 0; n < tries(100, 20);) {
    states.next();
    bench.section.compliance = 0.015 * states.dq.cwiseAbs().cwiseMin(1.0);
    for (Cuboid& box : bench.boxes)
      box = {{{9.0, 9.0, 9.0}, {1.0, 0.0, 0.0, 0.0}}, {0.02, 0.02, 0.02}};
    if (bench.nearest(states.q).distance < 0.02) continue;
    ++n;
    Vector3 begin, end;
    tip_height(bench, states.q, &begin);
    tip_height(bench, states.q + balance(bench, states.q), &end);
    bench.boxes[0].pose.p = end;
    if (!((end - begin).norm() > 0.1)) continue;
    ++far;
    bench.start();
    ASSERT_STATUS(bench.check(states.q, JointVector::Zero()), Status::kCollision);
  }
  assert_true(far > tries(20, 3));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_box_where_the_payload_pulls_the_tip_to_is_a_contact),
      cmocka_unit_test(link_frames_are_those_of_kdl),
      cmocka_unit_test(pairs_that_always_touch_are_those_of_the_table),
      cmocka_unit_test(capsules_stand_in_the_order_of_their_links),
      cmocka_unit_test(an_allowed_pair_is_not_checked),
      cmocka_unit_test(every_capsule_that_moves_is_checked_against_a_box),
      cmocka_unit_test(what_is_not_finite_is_no_pass),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
