// References given in the client's own frames.
#include "kernel/reference/space/task_space.hpp"
#include "kernel/streams/generator_streams.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kQuintic = kVelocityField | kAccelerationField;

Vector3 any_vector(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

Pose any_pose(Random& random, double size) {
  const Vector3 turn = any_vector(random, 1.5);
  return {any_vector(random, size),
          Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized()))};
}

Vector6 any_six(Random& random, double size) {
  Vector6 six;
  six << any_vector(random, size), any_vector(random, size);
  return six;
}

Eigen::Isometry3d transform(const Pose& pose) {
  return Eigen::Translation3d(pose.p) * pose.r;
}

/// A task-space generator with stores for a few waypoints.
struct TaskBench {
  ChannelMemory<TaskSpace> channel;
  std::array<std::array<Waypoint<TaskSpace>, 8>, kStores> waypoints;
  ReferenceClient<TaskSpace> client{channel};
  ReferenceGenerator<TaskSpace> generator;

  explicit TaskBench(const TaskSpace::Point& measured = {}) {
    channel.settings.period_s = 1e-3;
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = 8;
    }
    ASSERT_OK(generator.start(channel, {}, measured));
  }
  Trajectory<TaskSpace>& add(double time_s, const TaskSpace::Point& point) {
    Trajectory<TaskSpace>& motion = *client.acquire();
    motion.fields = kQuintic;
    motion.waypoints[motion.count++] = {time_s, point};
    return motion;
  }
  void run(int cycles) {
    for (int k = 0; k < cycles; ++k) ASSERT_OK(generator.step(1e-3, generator.reference()));
  }
  /// The last report.
  Report report() {
    Report last;
    while (client.poll(last)) {
    }
    return last;
  }
};

// Proves RG-19.

void a_pose_and_its_motion_are_those_of_the_frame_they_are_given_in(void**) {
  Random random{1};
  for (int i = 0; i < 200; ++i) {
    const Pose frame = any_pose(random, 1.0);
    TaskSpace::Point given;
    given.x = any_pose(random, 1.0);
    given.v = any_six(random, 1.0);
    given.a = any_six(random, 1.0);
    given.h = any_six(random, 10.0);
    const TaskSpace::Point placed =
        TaskSpace::placed(given, TaskSpace::latch({&frame, {}}, {}, TaskLimits()));
    const Eigen::Isometry3d expected = transform(frame) * transform(given.x);
    assert_true(transform(placed.x).isApprox(expected, 1e-13));
    // After a short time, the pose of the moving tip taken along with its frame.
    const double dt = 1e-6;
    const Vector3 later = transform(frame) * (given.x.p + dt * given.v.head<3>());
    ASSERT_NEAR((later - (placed.x.p + dt * placed.v.head<3>())).norm(), 0.0, 1e-14);
    ASSERT_NEAR((placed.a.tail<3>() - transform(frame).linear() * given.a.tail<3>()).norm(), 0.0,
                1e-14);
    assert_true(placed.h == given.h);
  }
}

/// The power of a wrench on a moving body does not depend on the point that wrench and velocity
/// refer to.
void a_wrench_about_its_frame_does_the_same_work_at_the_tip(void**) {
  Random random{2};
  for (int i = 0; i < 200; ++i) {
    const Pose frame = any_pose(random, 1.0);
    TaskSpace::Point given;
    given.x = any_pose(random, 1.0);
    given.h = any_six(random, 10.0);
    const TaskSpace::Point placed =
        TaskSpace::placed(given, TaskSpace::latch({{}, &frame}, {}, TaskLimits()));
    const Vector6 twist = any_six(random, 1.0);  // of the body, at the tip, in the base frame
    const Eigen::Matrix3d to_frame = transform(frame).linear().transpose();
    const Vector3 w = twist.tail<3>();
    const Vector3 v_there = twist.head<3>() + w.cross(frame.p - given.x.p);
    const double there =
        given.h.head<3>().dot(to_frame * v_there) + given.h.tail<3>().dot(to_frame * w);
    ASSERT_NEAR(placed.h.dot(twist), there, 1e-12);
  }
}

/// Checks dh against differences of h(t) for a tip that moves at v.
void the_rate_of_a_wrench_counts_the_tip_that_moves(void**) {
  Random random{3};
  for (int i = 0; i < 50; ++i) {
    const Pose frame = any_pose(random, 1.0);
    const TaskSpace::Placement placement = TaskSpace::latch({{}, &frame}, {}, TaskLimits());
    TaskSpace::Point given;
    given.x = any_pose(random, 1.0);
    given.v = any_six(random, 1.0);
    given.h = any_six(random, 10.0);
    given.dh = any_six(random, 10.0);
    const double dt = 1e-4;
    TaskSpace::Point before = given, after = given;
    before.x.p -= dt * given.v.head<3>();
    after.x.p += dt * given.v.head<3>();
    before.h -= dt * given.dh;
    after.h += dt * given.dh;
    const Vector6 rate =
        (TaskSpace::placed(after, placement).h - TaskSpace::placed(before, placement).h) /
        (2.0 * dt);
    ASSERT_NEAR((TaskSpace::placed(given, placement).dh - rate).norm(), 0.0, 1e-8);
  }
}

void a_trajectory_is_followed_in_its_frame_as_it_stood_at_acceptance(void**) {
  static TaskBench bench;
  Random random{4};
  Pose frame = any_pose(random, 0.3);
  TaskSpace::Point goal;
  goal.x = any_pose(random, 0.3);
  Trajectory<TaskSpace>& motion = bench.add(4.0, goal);
  motion.header.motion = &frame;
  std::uint32_t id = 0;
  assert_true(bench.client.send(motion, id).ok());
  const Eigen::Isometry3d expected = transform(frame) * transform(goal.x);
  bench.run(1500);
  frame = any_pose(random, 0.3);  // it moves on; the trajectory does not
  bench.run(2600);
  assert_true(transform(bench.generator.reference().x).isApprox(expected, 1e-12));
  assert_int_equal(static_cast<int>(bench.report().outcome), static_cast<int>(Outcome::kSucceeded));
}

void a_point_is_put_out_in_its_frame(void**) {
  static TaskBench bench;
  Random random{5};
  const Pose frame = any_pose(random, 0.3);
  TaskSpace::Point point;
  point.x = any_pose(random, 0.3);
  std::uint32_t id = 0;
  assert_true(bench.client.send(point, id, {&frame, nullptr}).ok());
  bench.run(1);
  const Eigen::Isometry3d expected = transform(frame) * transform(point.x);
  assert_true(transform(bench.generator.reference().x).isApprox(expected, 1e-12));
}

void a_frame_that_puts_a_path_outside_is_refused_when_it_is_met(void**) {
  static TaskBench bench;
  const Pose frame = {Vector3(1.5, 0.0, 0.0), Eigen::Quaterniond::Identity()};
  TaskSpace::Point point;
  point.x.p = {0.6, 0.0, 0.0};
  Trajectory<TaskSpace>& motion = bench.add(3.0, {});
  bench.add(6.0, point);
  motion.header.motion = &frame;
  std::uint32_t id = 0;
  assert_true(bench.client.send(motion, id).ok());
  bench.run(1);
  const Verdict verdict = bench.report().verdict;
  ASSERT_STATUS(verdict.status, Status::kWorkspace);
  assert_int_equal(verdict.axis, 0);
  ASSERT_NEAR(verdict.value, 2.1, 1e-12);
  assert_true(bench.generator.reference().standing());
}

void a_lever_that_makes_a_moment_too_large_is_refused_when_it_is_met(void**) {
  static TaskBench bench;
  const Pose frame = {Vector3(0.0, 1.0, 0.0), Eigen::Quaterniond::Identity()};
  TaskSpace::Point point;
  point.h[0] = 0.9 * TaskLimits().moment_max;  // on an arm of 1 m, and 1.2 m at the other end
  Trajectory<TaskSpace>& motion = bench.add(3.0, point);
  point.x.p = {0.0, -0.2, 0.0};
  bench.add(6.0, point);
  motion.fields = static_cast<Fields>(motion.fields | kEffortField);
  motion.header.wrench = &frame;
  std::uint32_t id = 0;
  assert_true(bench.client.send(motion, id).ok());
  bench.run(1);
  ASSERT_STATUS(bench.report().verdict.status, Status::kEffortLimit);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_pose_and_its_motion_are_those_of_the_frame_they_are_given_in),
      cmocka_unit_test(a_wrench_about_its_frame_does_the_same_work_at_the_tip),
      cmocka_unit_test(the_rate_of_a_wrench_counts_the_tip_that_moves),
      cmocka_unit_test(a_trajectory_is_followed_in_its_frame_as_it_stood_at_acceptance),
      cmocka_unit_test(a_point_is_put_out_in_its_frame),
      cmocka_unit_test(a_frame_that_puts_a_path_outside_is_refused_when_it_is_met),
      cmocka_unit_test(a_lever_that_makes_a_moment_too_large_is_refused_when_it_is_met),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
