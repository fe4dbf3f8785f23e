// Tests the rigid-body algorithms against the laws of mechanics: derivatives, energy, symmetry.
#include <Eigen/Cholesky>

#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// Potential energy, J, from a product of homogeneous transforms; it shares only the table with the
/// algorithms.
double potential_energy(const JointVector& q, const Tool& tool) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const auto go_to = [&frame](const JointFrame& next) {
    frame.translate(Vector3(next.x, next.y, next.z));
    frame.rotate(Eigen::AngleAxisd(next.roll(), Vector3::UnitX()));
    frame.rotate(Eigen::AngleAxisd(next.turn, Vector3::UnitZ()));
  };
  double energy = 0.0;
  for (std::size_t i = 0; i < kDof; ++i) {
    const LinkInertia& link = Robot::kLinks[i];
    go_to(Robot::kJoints[i]);
    const double position = q[static_cast<int>(i)];
    if (is_prismatic<Robot>(static_cast<int>(i))) {
      frame.translate(position * Vector3::UnitZ());
    } else {
      frame.rotate(Eigen::AngleAxisd(position, Vector3::UnitZ()));
    }
    energy += link.mass * kGravity_m_s2 * (frame * Vector3(link.cx, link.cy, link.cz)).z();
  }
  go_to(Robot::kFlange);
  return energy + tool.mass_kg * kGravity_m_s2 * (frame * tool.com).z();
}

double energy(const JointVector& q, const JointVector& dq, const Tool& tool) {
  return 0.5 * dq.dot(mass_matrix(q, tool) * dq) + potential_energy(q, tool);
}

// Proves MOD-1.

void jacobian_is_the_derivative_of_the_pose_of_the_tip(void**) {
  const Pose tip = skew_tool().tip;
  const double h = 1e-5;
  RandomStates state;
  for (int n = 0; n < 100; ++n) {
    state.next();
    const Vector6 twist = tip_jacobian(state.q, tip) * state.dq;
    const Pose after = tip_pose(state.q + h * state.dq, tip);
    const Pose before = tip_pose(state.q - h * state.dq, tip);
    const Vector3 v = (after.p - before.p) / (2.0 * h);
    Eigen::Quaterniond turn = after.r * before.r.conjugate();
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    const Vector3 w = turn.vec() / h;  // turn.vec() = w sin(h |w|) / |w|
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(v[i], twist[i], 1e-7);
    for (int i = 0; i < 3; ++i) ASSERT_NEAR(w[i], twist[3 + i], 1e-7);
  }
}

// Proves MOD-2.

void tip_frame_is_fixed_in_the_flange_frame(void**) {
  const Pose tip = skew_tool().tip;
  RandomStates state;
  for (int n = 0; n < 100; ++n) {
    state.next();
    const Pose flange = tip_pose(state.q, {}), x = tip_pose(state.q, tip);
    const Vector3 p = flange.r.conjugate() * (x.p - flange.p);
    assert_true((p - tip.p).cwiseAbs().maxCoeff() < 1e-14);
    const Eigen::Quaterniond r = flange.r.conjugate() * x.r;
    assert_true(r.angularDistance(tip.r) < 1e-7);  // an arc cosine close to 1
  }
}

void gravity_is_the_gradient_of_potential_energy(void**) {
  const Tool tool = skew_tool();
  const double h = 1e-5;
  RandomStates state;
  for (int n = 0; n < 100; ++n) {
    state.next();
    const JointVector g = gravity_at(state.q, tool);
    for (int i = 0; i < kDof; ++i) {
      const JointVector step = h * JointVector::Unit(i);
      const double rise =
          potential_energy(state.q + step, tool) - potential_energy(state.q - step, tool);
      ASSERT_NEAR(g[i], rise / (2.0 * h), 1e-7);
    }
  }
}

void a_tool_adds_its_weight_through_the_jacobian_of_its_centre_of_mass(void**) {
  const Tool tool = skew_tool();
  Pose com;
  com.p = tool.com;
  RandomStates state;
  for (int n = 0; n < 100; ++n) {
    state.next();
    Vector6 lift = Vector6::Zero();
    lift[2] = tool.mass_kg * kGravity_m_s2;
    const JointVector expected = tip_jacobian(state.q, com).transpose() * lift;
    const JointVector added = gravity_at(state.q, tool) - gravity_at(state.q, {});
    assert_true((added - expected).cwiseAbs().maxCoeff() < 1e-13);
  }
}

// Proves MOD-1.

void at_rest_inverse_dynamics_is_gravity(void**) {
  const Tool tool = skew_tool();
  const JointVector zero = JointVector::Zero();
  RandomStates state;
  for (int n = 0; n < 100; ++n) {
    state.next();
    const JointVector difference = rnea(state.q, zero, zero, tool) - gravity_at(state.q, tool);
    assert_true(difference.cwiseAbs().maxCoeff() < 1e-13);
  }
}

void mass_matrix_is_symmetric_and_positive_definite(void**) {
  RandomStates state;
  for (const Tool& tool : {Tool{}, skew_tool()}) {
    for (int n = 0; n < 100; ++n) {
      state.next();
      const JointMatrix m = mass_matrix(state.q, tool);
      assert_true((m - m.transpose()).cwiseAbs().maxCoeff() < 1e-13);
      assert_true(m.llt().info() == Eigen::Success);
    }
  }
}

void the_power_of_the_joints_is_the_change_of_energy(void**) {
  const Tool tool = skew_tool();
  const double h = 1e-5;
  RandomStates state;
  for (int n = 0; n < 100; ++n) {
    state.next();
    const JointVector &q = state.q, &dq = state.dq, &ddq = state.ddq;
    const JointVector curve = 0.5 * h * h * ddq;
    const double after = energy(q + h * dq + curve, dq + h * ddq, tool);
    const double before = energy(q - h * dq + curve, dq - h * ddq, tool);
    const double power = rnea(q, dq, ddq, tool).dot(dq);
    ASSERT_NEAR((after - before) / (2.0 * h), power, 1e-6 * (1.0 + std::abs(power)));
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(jacobian_is_the_derivative_of_the_pose_of_the_tip),
      cmocka_unit_test(tip_frame_is_fixed_in_the_flange_frame),
      cmocka_unit_test(gravity_is_the_gradient_of_potential_energy),
      cmocka_unit_test(a_tool_adds_its_weight_through_the_jacobian_of_its_centre_of_mass),
      cmocka_unit_test(at_rest_inverse_dynamics_is_gravity),
      cmocka_unit_test(mass_matrix_is_symmetric_and_positive_definite),
      cmocka_unit_test(the_power_of_the_joints_is_the_change_of_energy),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
