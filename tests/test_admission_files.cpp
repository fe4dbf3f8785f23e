// Well-formed trajectories that the robot must not follow, or only just may: tests/hostile, each
// with the verdict in its first line. The client judges first, the generator what only it can know.
#include <cstdio>

#include "gateway/reference_client.hpp"
#include "gateway/trajectory_csv.hpp"
#include "tests/loader_bench.hpp"
#include "tests/refused_files.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

constexpr int kCapacity = 16;

LoaderBench bench;
std::array<std::array<Waypoint<JointSpace>, kCapacity>, kStores> storage;

/// A channel, its client and the pipeline at the ready pose, all new.
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

/// The verdict of the client or, if it lets the trajectory pass, of the generator's next cycle,
/// which is then started anew.
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

/// As the first line of a file has it: "kVelocityLimit waypoint 2 joint 1".
Message words(const Verdict& verdict) {
  if (verdict.ok()) return Message("accepted");
  Message text(name(verdict.status));
  if (verdict.waypoint >= 0) text << " waypoint " << verdict.waypoint + 1;
  if (verdict.axis >= 0) text << " joint " << verdict.axis + 1;
  return text;
}

/// The same with what follows where a file says so: "value 2.25 limit 2.175".
Message words_with_value(const Verdict& verdict) {
  std::array<char, 64> numbers;
  std::snprintf(numbers.data(), numbers.size(), " value %.7g limit %.7g", verdict.value,
                verdict.limit);
  return words(verdict) << numbers.data();
}

// Proves RG-6, RG-7.

void every_hostile_trajectory_gets_the_verdict_of_its_first_line(void**) {
  ReferenceClient<JointSpace>& client = start();
  const auto as_expected = [&](const RefusedFile& file) {
    Trajectory<JointSpace>* trajectory = client.acquire();
    CsvError error;
    assert_non_null(trajectory);
    assert_true(read_trajectory(file.path.data(), false, *trajectory, error));
    trajectory->exact = true;
    const Verdict verdict = judge(client, *trajectory);
    const bool valued = file.expected.find(" value ") != std::string_view::npos;
    return file.expects(valued ? words_with_value(verdict) : words(verdict));
  };
  assert_true(judge_refused_files("tests/hostile", ".csv", as_expected) >= 90);
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
    assert_string_equal(words(judge(client, trajectory)).c_str(), "kReferenceSize");
  }
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
      assert_string_equal(words(judge(client, trajectory)).c_str(),
                          "kReferenceNotFinite waypoint 2 joint 5");
    }
    Trajectory<JointSpace>& trajectory = two_waypoints(client);
    trajectory.waypoints[0].time_s = bad;
    assert_string_equal(words(judge(client, trajectory)).c_str(), "kReferenceNotFinite waypoint 1");
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
      cmocka_unit_test(a_number_that_is_not_finite_is_refused_wherever_it_stands),
      cmocka_unit_test(what_touches_its_limits_and_no_more_is_admitted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
