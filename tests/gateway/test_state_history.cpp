// Tests where relative targets find the state of an observation.
#include "gateway/state_history.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

/// Joint 1 on a parabola, commanded and, a tenth of a radian behind, measured.
double way(double t) {
  return 0.05 * t * t;
}

/// A history of five seconds, with a message every `spacing_s`.
StateHistory<JointSpace>& history(double spacing_s) {
  static StateHistory<JointSpace> history;
  history = {};
  Feedback<JointSpace> feedback;
  const int messages = static_cast<int>(5.0 / spacing_s + 0.5);
  for (int i = 0; i <= messages; ++i) {
    feedback.time_s = i * spacing_s;
    feedback.desired.q[0] = way(feedback.time_s);
    feedback.actual.q[0] = way(feedback.time_s) - 0.1;
    history.push(feedback);
  }
  return history;
}

// Proves RG-32.

void two_seconds_are_kept_whatever_the_rate_of_feedback(void**) {
  for (const double spacing_s : {1e-3, 2e-3, 8e-3, 1e-2}) {
    const StateHistory<JointSpace>& states = history(spacing_s);
    JointSpace::Point position;
    for (double age_s = 0.0; age_s <= kHistory_s; age_s += 0.0137) {
      assert_true(states.find(5.0 - age_s, false, position));
      ASSERT_NEAR(position.q[0], way(5.0 - age_s), 1e-5);
      assert_true(states.find(5.0 - age_s, true, position));
      ASSERT_NEAR(position.q[0], way(5.0 - age_s) - 0.1, 1e-5);
    }
    assert_false(states.find(5.001, false, position));
  }
}

void a_restarted_generator_has_no_past(void**) {
  StateHistory<JointSpace>& states = history(1e-2);
  Feedback<JointSpace> feedback;
  feedback.time_s = 0.01;
  states.push(feedback);
  JointSpace::Point position;
  assert_true(states.find(0.01, false, position));
  assert_false(states.find(4.0, false, position));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(two_seconds_are_kept_whatever_the_rate_of_feedback),
      cmocka_unit_test(a_restarted_generator_has_no_past),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
