// Tests the joints' reachable positions until rest: every permitted way of stopping stays inside
// the boxes.
#include "kernel/guard/stopping.hpp"

#include <array>
#include <random>

#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

using StoppingBoxes = std::array<JointBox, kSections>;

StoppingBoxes stopping_boxes(const Braking& braking, const JointVector& q, const JointVector& dq) {
  StoppingBoxes boxes;
  for (int i = 0; i < kSections; ++i)
    boxes[static_cast<std::size_t>(i)] = stopping_box(braking, q, dq, i);
  return boxes;
}

struct Draw {
  std::mt19937_64 random{11};
  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }
  double share() { return std::clamp(2.0 * unit(), 0.0, 1.0); }
  double scale() { return std::pow(10.0, -1.5 + 1.5 * unit()); }
};

bool within(const JointBox& box, int joint, double q) {
  return std::abs(q - box.middle[joint]) <= box.half[joint] + 1e-9;
}

/// Whether the whole arm is in one of the boxes.
bool is_inside(const StoppingBoxes& boxes, const JointVector& q) {
  for (const JointBox& box : boxes) {
    int joints = 0;
    for (int j = 0; j < kDof; ++j) joints += within(box, j, q[j]);
    if (joints == kDof) return true;
  }
  return false;
}

/// Applies any acceleration until braking begins, then any speed between the two ramps.
void assert_contains(const Braking& braking, const JointVector& q0, const JointVector& dq0,
                     Draw& draw) {
  const StoppingBoxes boxes = stopping_boxes(braking, q0, dq0);
  const JointVector range = stopping_range(braking, dq0).array() + 1e-9;
  constexpr int kSteps = 40;
  JointVector q = q0, dq = dq0;
  const double h = braking.reaction_s / kSteps;
  for (int k = 0; k < kSteps; ++k) {
    for (int j = 0; j < kDof; ++j) {
      const double ddq = braking.acceleration[j] * (draw.share() * 2.0 - 1.0);
      q[j] += h * dq[j] + 0.5 * h * h * ddq;
      dq[j] += h * ddq;
      assert_true(within(boxes[0], j, q[j]));
    }
  }
  const JointVector own_s = dq.cwiseAbs().cwiseQuotient(braking.deceleration);
  const double t_s = own_s.maxCoeff();
  JointVector share;  // the common ramp's share of the speed
  for (double& x : share) x = draw.share();
  for (int k = 0; k <= 100; ++k) {
    const double s = t_s * k / 100;
    JointVector now = q;
    for (int j = 0; j < kDof; ++j) {
      const double own = std::min(s, own_s[j]);
      now[j] += dq[j] * (share[j] * (s - 0.5 * s * s / t_s) +
                         (1.0 - share[j]) * (own - 0.5 * own * own / own_s[j]));
    }
    assert_true(is_inside(boxes, now));
    assert_true(((now - q0).array().abs() <= range.array()).all());
  }
}

// Proves COL-3.

void every_stop_that_is_meant_is_within(void**) {
  Draw draw;
  RandomStates states;
  for (int i = 0; i < 3000; ++i) {
    states.next();
    Braking braking;
    braking.reaction_s = 0.02 * draw.share() + 1e-4;
    for (int j = 0; j < kDof; ++j) {
      braking.acceleration[j] = 20.0 * draw.scale();
      braking.deceleration[j] = 20.0 * draw.scale();
    }
    assert_contains(braking, states.q, draw.scale() * states.dq, draw);
  }
}

void at_rest_only_the_reaction_counts(void**) {
  Braking braking;
  braking.reaction_s = 0.01;
  braking.acceleration = braking.deceleration = JointVector::Constant(10.0);
  const StoppingBoxes boxes =
      stopping_boxes(braking, JointVector::Constant(0.3), JointVector::Zero());
  // a t^2 / 2 to gain speed, and as much to lose it
  for (int j = 0; j < kDof; ++j) {
    ASSERT_NEAR(boxes[0].half[j], 5e-4, 1e-15);
    ASSERT_NEAR(boxes[kBrakes].half[j], 1e-3, 1e-15);
    ASSERT_NEAR(boxes[kBrakes].middle[j], 0.3, 1e-15);
  }
}

/// At 2 rad/s and 5 rad/s^2, without reaction time: 0.4 s and 0.4 rad. Another joint at half the
/// speed comes to rest after 0.1 rad by itself and after 0.2 rad with the first.
void the_last_section_ends_where_the_ramps_do(void**) {
  Braking braking;
  braking.deceleration = JointVector::Constant(5.0);
  JointVector dq = JointVector::Zero();
  dq[0] = 2.0;
  dq[1] = -1.0;
  const StoppingBoxes boxes = stopping_boxes(braking, JointVector::Zero(), dq);
  const JointBox& last = boxes[kBrakes];
  ASSERT_NEAR(last.middle[0] + last.half[0], 0.4, 1e-15);
  ASSERT_NEAR(last.middle[0] - last.half[0], 0.4 * (1.0 - 1.0 / kBrakes), 1e-15);
  ASSERT_NEAR(last.middle[1] - last.half[1], -0.2, 1e-15);
  ASSERT_NEAR(last.middle[1] + last.half[1], -0.1, 1e-15);
  ASSERT_NEAR(last.half[2], 0.0, 0.0);
  const JointVector range = stopping_range(braking, dq);
  ASSERT_NEAR(range[0], 0.4, 1e-15);
  ASSERT_NEAR(range[1], 0.2, 1e-15);
  ASSERT_NEAR(range[2], 0.0, 0.0);
}

// Proves COL-4.

void nan_is_handed_on(void**) {
  Braking braking;
  braking.reaction_s = 0.01;
  braking.acceleration = braking.deceleration = JointVector::Constant(10.0);
  JointVector dq = JointVector::Zero();
  dq[1] = std::nan("");
  for (const JointBox& box : stopping_boxes(braking, JointVector::Zero(), dq))
    assert_true(std::isnan(box.middle[1]) || std::isnan(box.half[1]));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_stop_that_is_meant_is_within),
      cmocka_unit_test(at_rest_only_the_reaction_counts),
      cmocka_unit_test(the_last_section_ends_where_the_ramps_do),
      cmocka_unit_test(nan_is_handed_on),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
