// The task-space reference generator as a block: it starts where the tip is, puts out the
// references it was given, and neither steps nor breaks a limit whatever is requested at any time.
#include "gateway/reference_client.hpp"
#include "kernel/reference/blocks/task_reference_generator.hpp"
#include "tests/reference/space/task_cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr int kWaypoints = 16;
constexpr Fields kQuintic = kVelocityField | kAccelerationField;
const TaskLimits kLimits;

/// A block with its client and a robot whose tip is where the reference was.
struct TaskBench {
  ChannelMemory<TaskSpace> channel;
  std::array<std::array<Waypoint<TaskSpace>, kWaypoints>, kStores> waypoints;
  ReferenceClient<TaskSpace> client{channel};
  Pose x = {{0.4, 0.1, 0.5}, exp_so3({3.0, 0.2, -0.1})};
  Pose measured = x;
  TaskReferenceGenerator block;

  TaskBench() {
    channel.settings.period_s = kPeriod_s;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = kWaypoints;
    }
    block.channel = &channel;
    block.x.source = &measured;
    static_cast<void>(block.start());
  }
  /// Steps one cycle and returns the reference that is put out.
  Status step() {
    TRY(block.step(kPeriod_s));
    measured = block.x_d.value;
    return Status::kOk;
  }
  TaskPoint out() const {
    return {block.x_d.value, block.v_d.value, block.a_d.value, block.h_d.value, block.dh_d.value};
  }
  Trajectory<TaskSpace>* trajectory(Fields fields) {
    Trajectory<TaskSpace>* empty = client.acquire();
    if (empty == nullptr) return nullptr;
    empty->count = 0;
    empty->fields = fields;
    empty->interpolation = Interpolation::kByFields;
    return empty;
  }
  /// Appends a waypoint near the home pose.
  Waypoint<TaskSpace>& add(Trajectory<TaskSpace>& to, double time_s, const Vector3& p,
                           const Vector3& phi) {
    Waypoint<TaskSpace>& waypoint = to.waypoints[to.count++];
    waypoint = {};
    waypoint.time_s = time_s;
    waypoint.point.x = {x.p + p, x.r * exp_so3(phi)};
    return waypoint;
  }
};

/// Checks that the reference moves from `before` to `after` in one period within its limits and
/// without a step, and that the quaternion is unit and keeps its sign.
void assert_smooth(const TaskPoint& before, const TaskPoint& after, const TaskLimits& limits) {
  constexpr double kOver = 1.0 + 1e-6, kRateJerk = 1.001, kBetween = 1.0001;
  const Vector6 dv = after.v - before.v, da = after.a - before.a;
  assert_true(after.v.head<3>().norm() <= limits.v_max * kOver);
  assert_true(after.v.tail<3>().norm() <= limits.w_max * kOver);
  assert_true(after.a.head<3>().norm() <= limits.a_max * kOver);
  assert_true(after.a.tail<3>().norm() <= limits.alpha_max * kOver);
  assert_true((after.x.p - before.x.p).norm() <= limits.v_max * kPeriod_s * kOver);
  assert_true(distance(after.x.r, before.x.r) <= 0.5 * limits.w_max * kPeriod_s * kOver);
  assert_true(dv.head<3>().norm() <= limits.a_max * kPeriod_s * kBetween);
  assert_true(dv.tail<3>().norm() <= limits.alpha_max * kPeriod_s * kBetween);
  assert_true(da.head<3>().norm() <= limits.j_max * kPeriod_s * kRateJerk);
  assert_true(da.tail<3>().norm() <= limits.dalpha_max * kPeriod_s * kRateJerk);
  ASSERT_NEAR(after.x.r.norm(), 1.0, 3e-15);
}

// Proves RG-3, RG-10.

void it_starts_at_the_measured_pose_without_motion_or_wrench(void**) {
  static TaskBench bench;
  const TaskPoint out = bench.out();
  assert_true(out.x.p == bench.x.p && out.x.r.coeffs() == bench.x.r.coeffs() && out.idle());
  bench.measured.r = negative(bench.x.r);
  ASSERT_OK(bench.block.start());
  assert_true(bench.out().x.r.coeffs() == bench.measured.r.coeffs());
  bench.measured.p[1] = std::nan("");
  ASSERT_STATUS(bench.block.start(), Status::kStateNotFinite);
}

void a_point_is_put_out_as_it_came_but_for_the_quaternions_sign_and_length(void**) {
  static TaskBench bench;
  bench.block.params.generator.online = OnlineMode::kForward;
  ASSERT_OK(bench.block.start());
  TaskPoint point;
  point.x = {bench.x.p, negative(bench.x.r)};
  point.v = six({0.1, 0.2, 0.3}, {0.4, 0.5, 0.6});
  point.h = six({-20.0, 0.0, 3.0}, {0.0, 1.0, 0.0});
  std::uint32_t id = 0;
  assert_true(bench.client.send(point, id).ok());
  ASSERT_OK(bench.step());
  const TaskPoint out = bench.out();
  assert_true(out.x.p == point.x.p && out.v == point.v && out.a == point.a && out.h == point.h);
  assert_true(out.x.r.coeffs() == bench.x.r.coeffs());
  point.x.r.coeffs() *= 1.0 + 5e-4;
  assert_true(bench.client.send(point, id).ok());
  ASSERT_OK(bench.step());
  ASSERT_NEAR(distance(bench.out().x.r, bench.x.r), 0.0, 1e-15);
  point.x.r.coeffs() *= 1.0 + 6e-4;
  ASSERT_STATUS(bench.client.send(point, id).status, Status::kQuaternion);
}

// Proves RG-2, RG-10.

void whatever_signs_the_waypoints_have_the_reference_keeps_its_own(void**) {
  static TaskBench bench;
  Trajectory<TaskSpace>* motion = bench.trajectory(kQuintic | kEffortField);
  for (int i = 1; i <= 8; ++i) {
    const double side = i == 8 ? 0.0 : 1.0 - 2.0 * (i % 2);
    Waypoint<TaskSpace>& waypoint =
        bench.add(*motion, i, 0.1 * side * Vector3::Ones(), {0.0, 0.5 * side, 0.4 * side});
    if (i % 3 != 0) waypoint.point.x.r = negative(waypoint.point.x.r);
    waypoint.point.h = six({0.0, 0.0, -10.0 * side}, Vector3::Zero());
  }
  std::uint32_t id = 0;
  assert_true(bench.client.send(*motion, id).ok());
  double farthest = 0.0, most = 0.0;
  for (int k = 0; k < 9000; ++k) {
    const TaskPoint before = bench.out();
    ASSERT_OK(bench.step());
    assert_smooth(before, bench.out(), kLimits);
    farthest = std::max(farthest, angle_between(bench.out().x.r, bench.x.r));
    most = std::max(most, bench.out().h.norm());
  }
  ASSERT_NEAR(farthest, std::sqrt(0.5 * 0.5 + 0.4 * 0.4), 1e-9);
  ASSERT_NEAR(most, 10.0, 0.05);
  assert_true(bench.out().idle());
  ASSERT_NEAR(distance(bench.out().x.r, bench.x.r), 0.0, 1e-12);
}

// Proves RG-11.

void a_cancel_stops_on_the_straight_line(void**) {
  static TaskBench bench;
  Trajectory<TaskSpace>* line = bench.trajectory(0);
  bench.add(*line, 2.0, {0.3, 0.0, 0.0}, {0.0, 0.0, 0.6});
  std::uint32_t id = 0;
  assert_true(bench.client.send(*line, id).ok());
  for (int k = 0; k < 500; ++k) ASSERT_OK(bench.step());
  assert_true(bench.client.cancel(id).ok());
  int cycles = 0;
  do {
    ASSERT_OK(bench.step());
    const TaskPoint now = bench.out();
    const Vector3 way = now.x.p - bench.x.p;
    const Vector3 turn = log_so3(bench.x.r.conjugate() * now.x.r);
    assert_close(way, {way.x(), 0.0, 0.0}, 1e-12);
    assert_close(turn, {0.0, 0.0, 2.0 * way.x()}, 1e-12);
  } while (!bench.out().standing() && ++cycles < 1000);
  assert_true(cycles > 10 && cycles < 500 && bench.out().x.p.x() < bench.x.p.x() + 0.3);
}

bool ask_something(TaskBench& bench, RandomVectors& random) {
  std::uint32_t id = 0;
  const int kind = static_cast<int>(random.between(0.0, 6.0));
  if (kind == 0) return bench.client.cancel(id).ok();
  if (kind == 1) return bench.client.set_override(random.between(0.0, 1.0), id).ok();
  if (kind == 2)
    return (random.unit() > 0.0 ? bench.client.pause(id) : bench.client.resume(id)).ok();
  Trajectory<TaskSpace>* motion = bench.trajectory(kQuintic);
  if (motion == nullptr) return false;
  double time_s = 0.0;
  for (int i = static_cast<int>(random.between(1.0, 5.0)); i > 0; --i) {
    time_s += random.between(0.5, 1.5);
    TaskPoint& point =
        bench.add(*motion, time_s, 0.2 * random.vector(), 0.5 * random.vector()).point;
    if (random.unit() > 0.0) point.x.r = negative(point.x.r);
    if (i > 1) point.v = six(0.3 * random.vector(), 0.5 * random.vector());
    if (i > 1) point.a = six(0.5 * random.vector(), random.vector());
  }
  return bench.client.send(*motion, id).ok();
}

/// Makes requests of every kind at random times; returns the number of trajectories started.
int ask_at_random(TaskBench& bench, int requests) {
  const TaskLimits& limits = bench.channel.settings.limits;
  RandomVectors random;
  int started = 0;
  for (int request = 0; request < requests; ++request) {
    ask_something(bench, random);
    for (int k = static_cast<int>(random.between(1.0, 600.0)); k > 0; --k) {
      const TaskPoint before = bench.out();
      ASSERT_OK(bench.step());
      assert_smooth(before, bench.out(), limits);
    }
    Report report;
    while (bench.client.poll(report)) started += report.outcome == Outcome::kStarted;
  }
  print_message("%d trajectories started\n", started);
  return started;
}

void no_request_at_any_instant_breaks_a_limit(void**) {
  static TaskBench bench;
  assert_true(ask_at_random(bench, 3000) > 400);
}

void a_limit_of_the_rotations_jerk_is_kept_at_any_instant_too(void**) {
  static TaskBench bench;
  bench.channel.settings.limits.dalpha_max = 60.0;  // some of those trajectories take more
  const int started = ask_at_random(bench, 1000);
  assert_true(started > 50 && started < 300);
}

// Proves RG-13.

void a_force_sensor_that_fails_does_not_keep_the_arm_from_stopping(void**) {
  static TaskBench bench;
  const Vector6 failed = Vector6::Constant(std::nan(""));
  bench.block.params.path_tolerance.position_m = 0.01;
  ASSERT_OK(bench.block.start());
  Trajectory<TaskSpace>* line = bench.trajectory(0);
  bench.add(*line, 2.0, {0.3, 0.0, 0.0}, Vector3::Zero());
  std::uint32_t id = 0;
  assert_true(bench.client.send(*line, id).ok());
  bench.block.h.source = &failed;
  for (int k = 0; k < 3000; ++k) ASSERT_OK(bench.block.step(kPeriod_s));  // the robot does not move
  assert_true((bench.out().x.p - bench.x.p).norm() < 0.02 && bench.out().standing());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_starts_at_the_measured_pose_without_motion_or_wrench),
      cmocka_unit_test(a_point_is_put_out_as_it_came_but_for_the_quaternions_sign_and_length),
      cmocka_unit_test(whatever_signs_the_waypoints_have_the_reference_keeps_its_own),
      cmocka_unit_test(a_cancel_stops_on_the_straight_line),
      cmocka_unit_test(no_request_at_any_instant_breaks_a_limit),
      cmocka_unit_test(a_limit_of_the_rotations_jerk_is_kept_at_any_instant_too),
      cmocka_unit_test(a_force_sensor_that_fails_does_not_keep_the_arm_from_stopping),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
