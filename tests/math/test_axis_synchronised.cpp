// Tests seven axes that arrive together: planned, stretched to the slowest and sampled again every
// cycle.
#include "tests/math/axis_cases.hpp"

namespace tactus {
namespace {

constexpr std::size_t kAxes = kFerAxes.size();

struct Arm {
  std::array<AxisState, kAxes> state;
  std::array<double, kAxes> target;

  /// Plans all axes for the duration of the slowest, which it returns.
  double plan(std::array<AxisPlan, kAxes>& plans) const {
    double longest = 0.0;
    for (std::size_t i = 0; i < kAxes; ++i) {
      plans[i] = plan_to(state[i], target[i], 0.0, kFerAxes[i]);
      longest = std::max(longest, plans[i].duration());
    }
    constexpr double kRounding = 1e-8;  // s: a smaller excess may be rounding
    for (std::size_t i = 0; i < kAxes; ++i)
      assert_true(stretch(plans[i], state[i], target[i], 0.0, kFerAxes[i], longest) ||
                  longest - plans[i].duration() < kRounding);
    return longest;
  }
  bool there(std::size_t i) const {
    return state[i].p == target[i] && state[i].v == 0.0 && state[i].a == 0.0;
  }
};

Arm random_arm(AxisRandom& random) {
  Arm arm;
  const double way = random.decades(-3, 0.5);
  for (std::size_t i = 0; i < kAxes; ++i) {
    arm.state[i] = random_inside(random, kFerAxes[i]);
    arm.target[i] = arm.state[i].p + way * random.between(-1.0, 1.0);
  }
  return arm;
}

// Proves MOT-5.

void planned_again_every_cycle_all_axes_arrive_in_the_same_cycle(void**) {
  AxisRandom random;
  for (int i = 0; i < 60; ++i) {
    const double period = i % 3 == 0 ? 0.001 : i % 3 == 1 ? 0.002 : 0.008;
    Arm arm = random_arm(random);
    std::array<AxisPlan, kAxes> plans;
    const double duration = arm.plan(plans);
    std::array<int, kAxes> arrived{};
    int cycle = 0;
    for (std::size_t left = kAxes; left > 0 && cycle * period < duration + 10.0 * period;) {
      arm.plan(plans);
      ++cycle;
      for (std::size_t k = 0; k < kAxes; ++k) {
        const AxisState before = arm.state[k];
        arm.state[k] = plans[k].at(period);
        const AxisLimits& l = kFerAxes[k];
        assert_true(std::abs(arm.state[k].v) <= l.v_hi * (1.0 + 1e-9));
        assert_true(std::abs(arm.state[k].a) <= l.a_up * (1.0 + 1e-9));
        assert_true(std::abs(arm.state[k].a - before.a) <= l.j * period * (1.0 + 1e-9));
        if (arrived[k] == 0 && arm.there(k)) {
          arrived[k] = cycle;
          --left;
        }
      }
    }
    const auto [first, last] = std::minmax_element(arrived.begin(), arrived.end());
    assert_true(*first == *last);
    ASSERT_NEAR(*first * period, duration, period + 1e-9);
  }
}

void every_axis_of_an_arm_can_be_stretched_to_the_slowest(void**) {
  AxisRandom random;
  for (int i = 0; i < 3000; ++i) {
    const Arm arm = random_arm(random);
    std::array<AxisPlan, kAxes> plans;
    const double duration = arm.plan(plans);
    for (std::size_t k = 0; k < kAxes; ++k) {
      ASSERT_NEAR(plans[k].duration(), duration, 1e-8);
      assert_lawful(plans[k], arm.state[k], {arm.target[k], 0.0}, kFerAxes[k], kFerAxes[k]);
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(planned_again_every_cycle_all_axes_arrive_in_the_same_cycle),
      cmocka_unit_test(every_axis_of_an_arm_can_be_stretched_to_the_slowest),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
