// References that give only some of the joints: the others are held.
#include <unistd.h>

#include "gateway/trajectory/trajectory_reader.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr Fields kQuintic = kVelocityField | kAccelerationField;
constexpr std::uint32_t kAllButThird = ((1U << kDof) - 1U) & ~4U;

std::array<Waypoint<JointSpace>, 4> storage;
Trajectory<JointSpace> trajectory;
CsvError error;

bool read_text(const char* text, bool partial) {
  char path[] = "/tmp/tactus-partial-XXXXXX";
  const int descriptor = mkstemp(path);
  assert_true(descriptor >= 0);
  assert_true(write(descriptor, text, std::strlen(text)) > 0);
  close(descriptor);
  trajectory = {};
  trajectory.waypoints = storage.data();
  trajectory.capacity = 4;
  const bool read = read_trajectory(path, partial, trajectory, error);
  std::remove(path);
  return read;
}

// Proves RG-19.

void joints_may_be_left_out_where_that_is_allowed_the_same_in_every_group(void**) {
  constexpr const char* kTwo = "time_s,q2_rad,q7_rad,dq7_rad_s,dq2_rad_s\n1,2,7,0.7,0.2\n";
  assert_false(read_text(kTwo, false));
  assert_true(std::string_view(error.reason) == "position: 2 columns, expected 7");
  assert_true(read_text(kTwo, true));
  assert_int_equal(trajectory.header.held, 0b0111101);
  const JointSpace::Point& point = trajectory.waypoints[0].point;
  assert_true(point.q[1] == 2.0 && point.q[6] == 7.0 && point.dq[1] == 0.2 && point.dq[6] == 0.7);
  for (const char* text :
       {"time_s,q2_rad,dq7_rad_s\n1,2,0.7\n", "time_s,q2_rad,q7_rad,dq7_rad_s\n1,2,7,0.7\n"}) {
    assert_false(read_text(text, true));
    assert_true(std::string_view(error.reason) ==
                "velocity: 1 column, expected one for each given position");
  }
  assert_false(read_text("time_s,dq7_rad_s\n1,0.7\n", true));
  assert_true(std::string_view(error.reason) == "position: 0 columns, expected 7");
}

void joints_that_are_not_given_hold_where_they_are(void**) {
  static ReferenceBench bench;
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintic);
  for (const double t : {1.0, 2.0}) {
    bench.add(*motion, t, 0.1 * t);
    JointVector& q = motion->waypoints[motion->count - 1].point.q;
    for (int j = 0; j < kDof; ++j) q[j] = j == 2 ? q[j] : 99.0;  // beyond every limit, but not used
  }
  motion->header.held = kAllButThird;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*motion, id).ok());
  for (int k = 0; k < 2100; ++k) {
    ASSERT_OK(bench.step());
    for (int j = 0; j < kDof; ++j) assert_true(j == 2 || bench.out().q[j] == bench.home.q[j]);
  }
  ASSERT_NEAR(bench.out().q[2] - bench.home.q[2], 0.2, 1e-12);
}

void joints_that_are_not_given_and_move_come_to_rest(void**) {
  static ReferenceBench bench;
  assert_true(bench.go(0.4, 2.0, kQuintic) != 0);
  ASSERT_OK(bench.run(1000));
  const JointSpace::Point at_acceptance = bench.out();
  Trajectory<JointSpace>* motion = bench.trajectory(kQuintic);
  bench.add(*motion, 2.0, 0.1);
  motion->header.held = kAllButThird;
  std::uint32_t id = 0;
  assert_true(bench.client.send(*motion, id).ok());
  ASSERT_OK(bench.run(2100));
  // The joint is held where it can stop, one cycle later: v / 2 times the time of the stop.
  const double v = at_acceptance.dq[0], a = JointLimits().ddq_max[0], j = JointLimits().dddq_max[0];
  ASSERT_NEAR(bench.out().q[0], at_acceptance.q[0] + 0.5 * v * (v / a + a / j), 1e-3);
  ASSERT_NEAR(bench.out().q[2] - bench.home.q[2], 0.1, 1e-12);
}

void a_point_of_some_joints_leaves_the_others(void**) {
  static ReferenceBench bench;
  JointSpace::Point point;
  point.q = bench.home.q + JointVector::Constant(0.3);
  std::uint32_t id = 0;
  assert_true(bench.client.send(point, id, {kAllButThird}).ok());
  ASSERT_OK(bench.step());
  ASSERT_NEAR(bench.out().q[2] - bench.home.q[2], 0.3, 1e-12);
  assert_true(bench.out().q[3] == bench.home.q[3]);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(joints_may_be_left_out_where_that_is_allowed_the_same_in_every_group),
      cmocka_unit_test(joints_that_are_not_given_hold_where_they_are),
      cmocka_unit_test(joints_that_are_not_given_and_move_come_to_rest),
      cmocka_unit_test(a_point_of_some_joints_leaves_the_others),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
