// Well-formed trajectories just inside and beyond the limits (tests/hostile), each with the
// expected verdict in its first line. The client judges them first, then the generator what only it
// knows.
#include "gateway/reference_client.hpp"
#include "gateway/trajectory/trajectory_reader.hpp"
#include "gateway/verdict_text.hpp"
#include "tests/load/loader_bench.hpp"
#include "tests/support/cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kCapacity = 16;

LoaderBench bench;
std::array<std::array<Waypoint<JointSpace>, kCapacity>, kStores> storage;

/// Restarts the pipeline at the ready pose and returns the client of its channel.
ReferenceClient<JointSpace>& start() {
  static ReferenceClient<JointSpace> client(bench.channel);
  ASSERT_OK(
      bench.load("[robot]\nname = fer\nperiod_us = 1000\ntau_c = robot.tau\n"
                 "[guard]\nstop_reserve = 0.1\n"
                 "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"));
  ASSERT_OK(bench.pipeline.start(state_at(0.0, 0.0)));
  for (std::size_t i = 0; i < storage.size(); ++i) {
    bench.channel.stores[i].waypoints = storage[i].data();
    bench.channel.stores[i].capacity = kCapacity;
  }
  return client;
}

/// Returns the verdict of the client or, if it admits the trajectory, of the generator in the next
/// cycle; then restarts the generator.
Verdict judge(ReferenceClient<JointSpace>& client, Trajectory<JointSpace>& trajectory) {
  std::uint32_t id = 0;
  Verdict verdict = client.send(trajectory, id);
  if (!verdict.ok()) return verdict;
  ASSERT_OK(bench.pipeline.step(state_at(0.0, 0.0)));
  Report report;
  assert_true(client.poll(report));
  assert_int_equal(report.id, id);
  verdict = report.verdict;
  ASSERT_OK(bench.pipeline.start(state_at(0.0, 0.0)));
  while (client.poll(report)) {
  }
  return verdict;
}

/// A verdict as an operator reads it, and as the first line of a file has it.
Message words(const Verdict& verdict) {
  return verdict.ok() ? Message("accepted") : describe(verdict, VerdictAxes::kJoints);
}

// Proves RG-6, RG-7.

void every_hostile_trajectory_gets_the_verdict_of_its_first_line(void**) {
  ReferenceClient<JointSpace>& client = start();
  const auto as_expected = [&](const FileCase& file) {
    Trajectory<JointSpace>* trajectory = client.acquire();
    CsvError error;
    assert_non_null(trajectory);
    assert_true(read_trajectory(file.path.data(), false, *trajectory, error));
    trajectory->exact = true;
    return file.expects(words(judge(client, *trajectory)));
  };
  assert_true(judge_cases("tests/hostile", as_expected) >= 98);
}

Trajectory<JointSpace>& two_waypoints(ReferenceClient<JointSpace>& client) {
  Trajectory<JointSpace>& trajectory = *client.acquire();
  trajectory.count = 2;
  trajectory.fields = 0;
  for (int i = 0; i < 2; ++i) {
    trajectory.waypoints[i] = {1.0 + i, {}};
    trajectory.waypoints[i].point.q = ready_pose();
  }
  return trajectory;
}

void a_count_that_is_none_or_more_than_the_store_holds_is_refused(void**) {
  ReferenceClient<JointSpace>& client = start();
  for (const int count : {0, -1, kCapacity + 1}) {
    Trajectory<JointSpace>& trajectory = two_waypoints(client);
    trajectory.count = count;
    const Message expected = Message("number of waypoints ")
                             << count << " is not from 1 to 16 (32)";
    assert_string_equal(words(judge(client, trajectory)).c_str(), expected.c_str());
  }
}

void a_store_in_which_a_waypoint_is_not_found_in_time_is_refused(void**) {
  ReferenceClient<JointSpace>& client = start();
  Trajectory<JointSpace>& trajectory = two_waypoints(client);
  trajectory.capacity = kMostWaypoints + 1;
  assert_string_equal(words(judge(client, trajectory)).c_str(),
                      "number of waypoints 32769 is not from 1 to 32768 (32)");
  trajectory.capacity = kMostWaypoints;
  assert_string_equal(words(judge(client, trajectory)).c_str(), "accepted");
}

// Proves RG-9.

void a_number_that_is_not_finite_is_refused_wherever_it_stands(void**) {
  ReferenceClient<JointSpace>& client = start();
  for (const double bad : {kRequired, kInfinity, -kInfinity}) {
    for (int field = 0; field < 4; ++field) {
      Trajectory<JointSpace>& trajectory = two_waypoints(client);
      trajectory.fields = kVelocityField | kAccelerationField | kEffortField;
      JointSpace::Point& point = trajectory.waypoints[1].point;
      JointVector* const values[] = {&point.q, &point.dq, &point.ddq, &point.tau};
      (*values[field])[4] = bad;
      const Message expected = Message("waypoint 2, joint 5 (fer_joint5): value ")
                               << bad << " is not finite (33)";
      assert_string_equal(words(judge(client, trajectory)).c_str(), expected.c_str());
    }
    Trajectory<JointSpace>& trajectory = two_waypoints(client);
    trajectory.waypoints[0].time_s = bad;
    const Message expected = Message("waypoint 1: value ") << bad << " is not finite (33)";
    assert_string_equal(words(judge(client, trajectory)).c_str(), expected.c_str());
  }
}

void a_stamp_that_is_not_finite_is_refused(void**) {
  ReferenceClient<JointSpace>& client = start();
  std::uint32_t id = 0;
  const JointSpace::Point point = {state_at(0.0, 0.0).q};
  PointDetails details;
  for (const double bad : {kRequired, kInfinity, -kInfinity}) {
    details.stamp_s = bad;
    ASSERT_STATUS(client.send(point, id, {}, details).status, Status::kReferenceNotFinite);
  }
}

// Proves RG-6.

void what_touches_its_limits_and_no_more_is_admitted(void**) {
  ReferenceClient<JointSpace>& client = start();
  const JointLimits limits;
  Trajectory<JointSpace>& trajectory = two_waypoints(client);
  trajectory.fields = kEffortField;
  trajectory.waypoints[0].time_s = 100.0;
  trajectory.waypoints[0].point.q = limits.q_max;
  trajectory.waypoints[0].point.tau = limits.tau_max;
  trajectory.waypoints[1].point.q = limits.q_max - limits.dq_max;
  trajectory.waypoints[1].time_s = 105.0;
  assert_string_equal(words(judge(client, trajectory)).c_str(), "accepted");
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_hostile_trajectory_gets_the_verdict_of_its_first_line),
      cmocka_unit_test(a_count_that_is_none_or_more_than_the_store_holds_is_refused),
      cmocka_unit_test(a_store_in_which_a_waypoint_is_not_found_in_time_is_refused),
      cmocka_unit_test(a_number_that_is_not_finite_is_refused_wherever_it_stands),
      cmocka_unit_test(a_stamp_that_is_not_finite_is_refused),
      cmocka_unit_test(what_touches_its_limits_and_no_more_is_admitted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
