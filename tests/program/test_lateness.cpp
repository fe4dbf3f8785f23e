// Tests the lateness of loops: against motions of a joint that is integrated step by step, the
// inertia of KDL, and in the words of `check`.
#include <cmath>
#include <random>
#include <string>

#include "program/session/lateness.hpp"
#include "tests/oracles/kdl.hpp"
#include "tests/program/program_bench.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

struct Joint {
  double m, kp, kd;
  bool takes_velocity;
};

/// How far a joint gets beyond its reference, which rests at 0; it begins at q with dq.
double beyond(const Joint& joint, double q, double dq) {
  const double dt_s = 1e-3 / (joint.kd / joint.m + std::sqrt(joint.kp / joint.m));
  double most = 0.0;
  for (int i = 0; i < 200'000; ++i) {
    dq -= dt_s * (joint.kp * q + joint.kd * dq) / joint.m;
    q += dt_s * dq;
    most = std::max(most, q);
  }
  return most;
}

Joint random_joint(std::mt19937_64& random) {
  std::uniform_real_distribution<double> decades(-1.0, 1.0);
  Joint joint = {std::pow(10.0, decades(random)), 300.0 * std::pow(10.0, decades(random)), 0.0,
                 random() % 2 == 0};
  joint.kd = 2.0 * std::pow(10.0, 0.7 * decades(random)) * std::sqrt(joint.kp * joint.m);
  return joint;
}

// Proves COL-15.

void a_joint_leaves_a_reference_that_rests_by_its_lateness(void**) {
  std::mt19937_64 random(7);
  for (int n = 0; n < tries(60, 10); ++n) {
    const Joint joint = random_joint(random);
    const double found = lateness(joint.m, joint.kp, joint.kd);
    ASSERT_NEAR(found, beyond(joint, 0.0, 1.0), 0.01 * found);
  }
}

/// A step of a reference whose velocity is taken kicks the joint.
void a_joint_overshoots_a_step_of_its_reference(void**) {
  std::mt19937_64 random(8);
  for (int n = 0; n < tries(60, 10); ++n) {
    const Joint joint = random_joint(random);
    const double kick = joint.takes_velocity ? joint.kd / joint.m : 0.0;
    const double found = overshoot(joint.m, joint.kp, joint.kd, joint.takes_velocity);
    ASSERT_NEAR(found, beyond(joint, -1.0, kick), 0.01 * found + 2e-3);
  }
}

/// A joint in any state, whose reference moves at random with growing and falling speed.
void no_motion_overshoots_by_more(void**) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  double most = 0.0;
  for (int n = 0; n < tries(2000, 100); ++n) {
    const Joint joint = random_joint(random);
    const double dt_s = 1e-2 / (joint.kd / joint.m + std::sqrt(joint.kp / joint.m));
    double q = any(random), dq = 20.0 * any(random), q_d = 0.0, dq_d = 0.0, way = 0.0;
    const double lag = std::abs(q), inertia = joint.m, kp = joint.kp, kd = joint.kd;
    const double begin = q, velocity = dq;
    double top = 0.0, highest = 0.0;  // of the reference, and of the joint above both
    const double bend = 50.0 * dt_s * any(random);
    for (int i = 0; i < 5000; ++i) {
      dq_d = i < 300 ? dq_d + bend * any(random) : 0.98 * dq_d;
      q_d += dt_s * dq_d;
      way += dt_s * std::abs(dq_d);
      top = std::max(top, q_d);
      dq += dt_s * (kp * (q_d - q) + kd * ((joint.takes_velocity ? dq_d : 0.0) - dq)) / inertia;
      q += dt_s * dq;
      highest = std::max(highest, q - std::max(top, begin));
    }
    const double allowed = lateness(inertia, kp, kd) * std::abs(velocity) +
                           overshoot(inertia, kp, kd, joint.takes_velocity) * (lag + way);
    assert_true(highest <= 1.02 * allowed + 1e-9);
    if (allowed > 0.0) most = std::max(most, highest / allowed);
  }
  assert_true(most > 0.7);
}

void no_posture_has_a_larger_inertia(void**) {
  Tool tool;
  tool.mass_kg = 0.7;
  tool.com = tool.tip.p = {0.02, 0.01, 0.15};
  const JointVector largest = largest_inertia(tool, 2.5);
  KdlTool both;
  both.mass_kg = 3.2;  // tool and payload, both at the tip
  for (int i = 0; i < 3; ++i) both.com[i] = tool.com[i];
  std::mt19937_64 random(11);
  JointVector found = JointVector::Zero();
  const JointLimits limits;
  for (int n = 0; n < 20'000; ++n) {
    JointVector q;
    for (int i = 0; i < kDof; ++i)
      q[i] = std::uniform_real_distribution<double>(limits.q_min[i], limits.q_max[i])(random);
    double m[kDof][kDof];
    kdl_mass_matrix(q.data(), both, m);
    for (int i = 0; i < kDof; ++i) found[i] = std::max(found[i], m[i][i]);
  }
  for (int i = 0; i < kDof; ++i) {
    assert_true(largest[i] > found[i] + kRotorInertia);
    assert_true(largest[i] < 1.2 * found[i] + kRotorInertia);
  }
}

constexpr const char* kSection = "[collision]\n";

int check(std::initializer_list<const char*> texts) {
  const Line path = write("lateness.ini", texts);
  return tactus_run({"check", path.c_str()});
}

void check_says_the_lateness_and_where_it_is_from(void**) {
  assert_int_equal(check({kPipeline, kSection}), 0);
  const double computed_s = number_after(output(), "lateness = ");
  assert_true(computed_s > 0.02 && computed_s < 0.1);
  assert_true(has(output(), " s, from gains and largest inertias\n"));
  assert_true(number_after(output(), "overshoot = ") < 0.1);
  assert_int_equal(check({kPipeline, kSection, "unknown_payload = 3\n"}), 0);
  assert_true(number_after(output(), "lateness = ") > computed_s);
  assert_true(number_after(output(), "compliance = ") > 0.001);
  assert_int_equal(check({kPipeline, kSection, "lateness = 0.2\n"}), 0);
  assert_true(has(output(), "lateness = 0.2 0.2 0.2 0.2 0.2 0.2 0.2 s, as the file gives it"));
  assert_false(has(errors(), "[collision] lateness"));
  assert_int_equal(check({kPipeline, kSection, "lateness = 0.2\novershoot = 0.5\n"}), 0);
  assert_true(has(output(), "overshoot = 0.5 0.5 0.5 0.5 0.5 0.5 0.5, as the file gives it"));
  assert_int_equal(check({kPipeline, kSection, "lateness = 0\n"}), 0);
  assert_true(has(errors(), "note: [collision] lateness: by gains and inertia it is 0.0"));
}

void what_is_not_known_has_to_be_given(void**) {
  std::string text(kPipeline);
  const std::size_t law = text.find("pd_gravity");
  text.replace(law, 10, "pid\nki = 0\nderivative_time_constant = 0.01");
  assert_int_equal(check({text.c_str(), kSection}), 2);
  assert_true(has(errors(), "lateness.ini:28: [collision] lateness: missing; "));
  assert_true(has(errors(), "[pd]: it filters the derivative"));
  text.replace(text.find("ki = 0"), 6, "ki = 1\nderivative = measurement");
  text.erase(text.find("derivative_time"), sizeof "derivative_time_constant = 0.01");
  assert_int_equal(check({text.c_str(), kSection}), 2);
  assert_true(has(errors(), "[pd]: its integral makes up for kd on the measurement"));
  assert_int_equal(check({text.c_str(), kSection, "lateness = 0.1\n"}), 0);
  assert_int_equal(check({kWithoutGenerator, kSection}), 2);
  assert_true(has(errors(), "no pd_gravity and no pid gives the torque"));
}

}  // namespace
}  // namespace tactus

int main(int /*argc*/, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_joint_leaves_a_reference_that_rests_by_its_lateness),
      cmocka_unit_test(a_joint_overshoots_a_step_of_its_reference),
      cmocka_unit_test(no_motion_overshoots_by_more),
      cmocka_unit_test(no_posture_has_a_larger_inertia),
      cmocka_unit_test(check_says_the_lateness_and_where_it_is_from),
      cmocka_unit_test(what_is_not_known_has_to_be_given),
  };
  return run_program_tests(argv[0], tests);
}
