// Feedback of both generators: all values of a message belong to one cycle, lost messages are
// counted, and values that are not measured are NaN.
// Tests the place on the path that feedback tells.
#include "kernel/math/so3.hpp"
#include "kernel/reference/blocks/task_reference_generator.hpp"
#include "kernel/reference/generator/feedback.hpp"
#include "tests/reference/generator/feedback_bench.hpp"

namespace tactus {
namespace {

struct TaskBench : Bench<TaskSpace, TaskReferenceGenerator> {
  explicit TaskBench(int divisor) : Bench(divisor) {
    measured.x = {{0.4, 0.1, 0.5}, exp_so3({2.0, -0.7, 1.0})};
    block.x.source = &measured.x;
  }
};

template <class Vector>
bool none(const Vector& v) {
  return v.array().isNaN().all();
}

// Proves RG-15.

void a_message_comes_every_divisor_cycles_at_the_generators_time(void**) {
  for (const int divisor : {1, 4, 10}) {
    JointBench bench(divisor);
    ASSERT_OK(bench.block.start());
    for (int k = 1; k <= 200; ++k) {
      bench.run(1);
      Feedback<JointSpace> message;
      assert_int_equal(bench.client.poll_feedback(message), k % divisor == 0);
      if (k % divisor == 0) assert_true(message.time_s == k * kPeriod_s && message.lost == 0);
    }
  }
  JointBench silent(0);
  ASSERT_OK(silent.block.start());
  silent.run(100);
  Feedback<JointSpace> message;
  assert_false(silent.client.poll_feedback(message));
}

void desired_actual_and_error_are_of_the_cycle_of_the_message(void**) {
  JointBench bench(3);
  bench.block.dq.source = &bench.measured.dq;
  bench.block.tau.source = &bench.measured.tau;
  ASSERT_OK(bench.block.start());
  JointSpace::Point goal = bench.measured;
  goal.q.array() += 0.2;
  assert_true(bench.send(goal, 0.5));
  for (int k = 1; k <= 450; ++k) {
    bench.measured.q[2] += 1e-4;
    bench.measured.dq.setConstant(0.01 * k);
    bench.measured.tau.setConstant(-0.02 * k);
    bench.run(1);
    if (k % 3 != 0) continue;
    const Feedback<JointSpace> message = bench.only();
    const JointSpace::Point out = bench.out();
    assert_true(message.desired.q == out.q && message.desired.dq == out.dq);
    assert_true(message.desired.ddq == out.ddq && message.desired.tau == out.tau);
    assert_true(message.actual.q == bench.measured.q && message.actual.dq == bench.measured.dq);
    assert_true(message.actual.tau == bench.measured.tau);
    assert_true(message.error.q == out.q - bench.measured.q);
    assert_true(message.error.dq == out.dq - bench.measured.dq);
    assert_true(message.error.tau == out.tau - bench.measured.tau);
    assert_int_equal(message.id, bench.id);
  }
}

void the_trajectory_is_named_while_it_is_executed_and_points_are_none(void**) {
  JointBench bench(1);
  ASSERT_OK(bench.block.start());
  bench.run(1);
  assert_int_equal(bench.only().id, 0);
  JointSpace::Point goal = bench.measured;
  goal.q[0] += 0.1;
  assert_true(bench.send(goal, 0.5));
  bench.run(1);
  assert_true(bench.id != 0 && bench.only().id == bench.id);
  std::uint32_t id = 0;
  goal.q[0] += 0.1;
  assert_true(bench.client.send(goal, id).ok());
  bench.run(1);
  const Feedback<JointSpace> message = bench.only();
  assert_int_equal(message.id, 0);
  ASSERT_NEAR(message.error.q[0], 0.2, 1e-15);  // positive: the robot is behind
}

void what_finds_no_room_is_lost_and_told_by_the_next(void**) {
  JointBench bench(2);
  ASSERT_OK(bench.block.start());
  bench.run(2 * (16 + 5));
  Feedback<JointSpace> message;
  for (int k = 1; k <= 16; ++k) {  // the oldest are kept
    assert_true(bench.client.poll_feedback(message));
    assert_true(message.lost == 0 && message.time_s == 2 * k * kPeriod_s);
  }
  assert_false(bench.client.poll_feedback(message));
  bench.run(2);
  assert_int_equal(bench.only().lost, 5);
  bench.run(2);
  assert_int_equal(bench.only().lost, 0);
}

void a_restart_begins_at_time_zero_and_forgets_no_loss(void**) {
  JointBench bench(2);
  ASSERT_OK(bench.block.start());
  bench.run(2 * (16 + 3) + 1);
  ASSERT_OK(bench.block.start());
  Feedback<JointSpace> message;
  while (bench.client.poll_feedback(message)) assert_int_equal(message.lost, 0);
  bench.run(2);
  message = bench.only();
  assert_true(message.time_s == 2 * kPeriod_s && message.lost == 3);
}

void the_error_of_a_pose_is_from_actual_to_desired_in_the_base_frame(void**) {
  TaskBench bench(1);
  ASSERT_OK(bench.block.start());
  const Eigen::Quaterniond held = bench.measured.x.r;
  const Vector3 p = bench.measured.x.p;
  for (const double sign : {1.0, -1.0}) {
    for (const Vector3& phi : {Vector3(0.1, 0.0, 0.0), Vector3(-0.3, 0.2, 1.0)}) {
      bench.measured.x.p = p - Vector3(0.01, -0.02, 0.03);
      bench.measured.x.r.coeffs() = sign * (exp_so3(-phi) * held).coeffs();
      bench.run(1);
      const Feedback<TaskSpace> message = bench.only();
      assert_true(message.actual.x.r.coeffs() == bench.measured.x.r.coeffs());
      assert_true(message.desired.x.p == p);
      ASSERT_NEAR((message.error.phi - phi).norm(), 0.0, 1e-14);
      ASSERT_NEAR((message.error.p - Vector3(0.01, -0.02, 0.03)).norm(), 0.0, 1e-15);
    }
  }
}

void what_is_not_measured_is_nan_in_joints(void**) {
  for (const bool wired : {false, true}) {
    JointBench bench(1);
    if (wired) bench.block.dq.source = &bench.measured.dq;
    if (wired) bench.block.tau.source = &bench.measured.tau;
    ASSERT_OK(bench.block.start());
    bench.run(1);
    const Feedback<JointSpace> message = bench.only();
    assert_true(message.desired.finite() && message.actual.q.allFinite());
    for (const JointSpace::Point& point : {message.actual, message.error}) {
      assert_true(point.q.allFinite() && none(point.ddq));
      assert_true(wired ? point.dq.allFinite() : none(point.dq));
      assert_true(wired ? point.tau.allFinite() : none(point.tau));
    }
  }
}

void what_is_not_measured_is_nan_at_the_tip(void**) {
  for (const bool wired : {false, true}) {
    TaskBench bench(1);
    if (wired) bench.block.v.source = &bench.measured.v;
    if (wired) bench.block.h.source = &bench.measured.h;
    bench.measured.v.setConstant(0.5);
    bench.measured.h.setConstant(3.0);
    ASSERT_OK(bench.block.start());
    bench.run(1);
    const Feedback<TaskSpace> message = bench.only();
    const TaskSpace::Point& actual = message.actual;
    const TaskSpace::Error& error = message.error;
    assert_true(message.desired.finite() && error.p.isZero(0.0) && error.phi.isZero(0.0));
    assert_true(none(actual.a) && none(actual.dh) && none(error.a) && none(error.dh));
    assert_true(wired ? actual.v == bench.measured.v : none(actual.v));
    assert_true(wired ? actual.h == bench.measured.h : none(actual.h));
    assert_true(wired ? error.v == -bench.measured.v : none(error.v));
    assert_true(wired ? error.h == -bench.measured.h : none(error.h));
  }
}

// Proves RG-15.

void the_progress_is_the_place_on_the_path_under_an_override_and_in_a_pause(void**) {
  constexpr double kWay = 0.2, kWhole_s = 0.5;
  JointBench bench(1);
  ASSERT_OK(bench.block.start());
  bench.run(1);
  assert_true(bench.only().path_s == 0.0);
  JointSpace::Point goal = bench.measured;
  goal.q[0] += kWay;
  assert_true(bench.send(goal, kWhole_s));
  std::uint32_t id = 0;
  int standing = 0, half = 0;
  double last_s = 0.0;
  for (int k = 1; k <= 2000; ++k) {
    if (k == 150) assert_true(bench.client.set_override(0.5, id).ok());
    if (k == 300) assert_true(bench.client.pause(id).ok());
    if (k == 600) assert_true(bench.client.resume(id).ok());
    bench.run(1);
    const Feedback<JointSpace> message = bench.only();
    Report report;
    while (bench.client.poll(report)) {
    }
    if (message.id == 0) continue;
    const double u = message.path_s / message.path_end_s;
    ASSERT_NEAR(message.path_end_s, kWhole_s, 1e-12);
    ASSERT_NEAR(message.desired.q[0] - bench.measured.q[0],
                kWay * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u), 1e-9);
    standing += message.path_s == last_s && u < 1.0 ? 1 : 0;
    half += std::abs(message.path_s - last_s - 0.5 * kPeriod_s) < 1e-9 ? 1 : 0;
    last_s = message.path_s;
  }
  ASSERT_NEAR(last_s, kWhole_s, 1e-9);
  assert_true(standing > 150 && half > 200);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_message_comes_every_divisor_cycles_at_the_generators_time),
      cmocka_unit_test(desired_actual_and_error_are_of_the_cycle_of_the_message),
      cmocka_unit_test(the_trajectory_is_named_while_it_is_executed_and_points_are_none),
      cmocka_unit_test(what_finds_no_room_is_lost_and_told_by_the_next),
      cmocka_unit_test(a_restart_begins_at_time_zero_and_forgets_no_loss),
      cmocka_unit_test(the_error_of_a_pose_is_from_actual_to_desired_in_the_base_frame),
      cmocka_unit_test(what_is_not_measured_is_nan_in_joints),
      cmocka_unit_test(what_is_not_measured_is_nan_at_the_tip),
      cmocka_unit_test(the_progress_is_the_place_on_the_path_under_an_override_and_in_a_pause),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
