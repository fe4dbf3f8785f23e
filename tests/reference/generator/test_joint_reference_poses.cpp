// Pose and twist that the joint-space generator puts out: compared with Orocos KDL at seeded
// joints, with and without a tool, and with each other's derivative along a trajectory.
#include "gateway/reference_client.hpp"
#include "kernel/reference/blocks/joint_reference_generator.hpp"
#include "tests/oracles/kdl.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/rotation_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3;

struct Bench {
  ChannelMemory<JointSpace> channel;
  ReferenceClient<JointSpace> client{channel};
  std::array<std::array<Waypoint<JointSpace>, 4>, kStores> waypoints;
  JointVector q = JointVector::Zero();
  Tool tool = skew_tool();
  JointReferenceGenerator block;
  std::uint32_t id = 0;

  explicit Bench(bool with_tool) {
    channel.settings.period_s = kPeriod_s;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = 4;
    }
    block.channel = &channel;
    block.params.generator.online = OnlineMode::kForward;
    block.q.source = &q;
    if (with_tool) block.tool.source = &tool;
  }
};

/// Returns pose and twist of the tip from KDL's flange and the tool's lever arm.
void assert_those_of_kdl(const JointVector& q, const JointVector& dq, const Pose& tip,
                         const JointReferenceGenerator& block) {
  double p[3], r[3][3], jacobian[6][7];
  kdl_flange(q.data(), p, r);
  kdl_jacobian(q.data(), jacobian);
  Matrix3 rotation;
  Vector6 twist = Vector6::Zero();
  for (int i = 0; i < 3; ++i) rotation.row(i) << r[i][0], r[i][1], r[i][2];
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < kDof; ++j) twist[i] += jacobian[i][j] * dq[j];
  }
  const Vector3 lever = rotation * tip.p;
  twist.head<3>() += twist.tail<3>().cross(lever);
  const Pose& x = block.x_d.value;
  ASSERT_NEAR((x.p - Vector3(p[0], p[1], p[2]) - lever).norm(), 0.0, 1e-14);
  ASSERT_NEAR((x.r.toRotationMatrix() - rotation * tip.r.toRotationMatrix()).norm(), 0.0, 1e-14);
  ASSERT_NEAR((block.v_d.value - twist).norm(), 0.0, 1e-13);
  ASSERT_NEAR(x.r.norm(), 1.0, 1e-15);
}

// Proves RG-16.

void pose_and_twist_are_those_of_kdl_with_and_without_a_tool(void**) {
  for (const bool with_tool : {false, true}) {
    Bench bench(with_tool);
    const Pose tip = with_tool ? bench.tool.tip : Pose();
    RandomStates state;
    Report report;
    for (int n = 0; n < 300; ++n) {
      state.next();
      bench.q = state.q;
      ASSERT_OK(bench.block.start());
      assert_those_of_kdl(state.q, JointVector::Zero(), tip, bench.block);
      assert_true(bench.block.x_d.value.r.w() >= 0.0);
      state.next();
      JointSpace::Point point;
      point.q = state.q;
      point.dq = state.dq;
      assert_true(bench.client.send(point, bench.id).ok());
      ASSERT_OK(bench.block.step(kPeriod_s));
      assert_those_of_kdl(state.q, state.dq, tip, bench.block);
      while (bench.client.poll(report)) assert_true(report.outcome == Outcome::kExecuted);
    }
  }
}

void twist_is_the_derivative_of_the_pose_and_the_quaternion_never_jumps(void**) {
  Bench bench(true);
  static std::array<Pose, 8001> x;
  static std::array<Vector6, 8001> v;
  // First and last joint from end to end: the tip turns by more than one revolution.
  bench.q << -2.5, 0.4, 0.0, -1.5, 0.3, 1.5, 2.5;
  bench.block.params.path_tolerance.setZero();  // nothing follows
  ASSERT_OK(bench.block.start());
  Trajectory<JointSpace>& motion = *bench.client.acquire();
  motion.count = 1;
  motion.fields = kVelocityField | kAccelerationField;
  motion.waypoints[0] = {};
  motion.waypoints[0].time_s = 7.9;
  motion.waypoints[0].point.q << 2.5, -0.4, 0.8, -2.0, -0.3, 2.0, -2.5;
  assert_true(bench.client.send(motion, bench.id).ok());
  double turned = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    ASSERT_OK(bench.block.step(kPeriod_s));
    x[k] = bench.block.x_d.value;
    v[k] = bench.block.v_d.value;
    if (k == 0) continue;
    assert_true(x[k].r.dot(x[k - 1].r) > 0.99);
    turned += log_so3(x[k - 1].r.conjugate() * x[k].r).norm();
  }
  assert_true(turned > 2.0 * kPi);
  for (std::size_t k = 4; k + 4 < x.size(); ++k) {
    const auto at = [&](double dt) {
      return x[static_cast<std::size_t>(std::lround(static_cast<double>(k) + dt / kPeriod_s))];
    };
    const auto p = [&](double dt) -> Vector3 { return at(dt).p; };
    const auto r = [&](double dt) -> Eigen::Vector4d { return at(dt).r.coeffs(); };
    const Eigen::Quaterniond dr(Eigen::Vector4d(first_derivative(r, kPeriod_s)));
    assert_close(first_derivative(p, kPeriod_s), v[k].head<3>(), 1e-7);
    assert_close(2.0 * (dr * x[k].r.conjugate()).vec(), v[k].tail<3>(), 1e-7);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(pose_and_twist_are_those_of_kdl_with_and_without_a_tool),
      cmocka_unit_test(twist_is_the_derivative_of_the_pose_and_the_quaternion_never_jumps),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
