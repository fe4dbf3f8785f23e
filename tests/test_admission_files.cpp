// Well-formed trajectories that the robot must not follow: tests/refused/admission, each with the
// verdict in its first line. The client judges first, the generator what only it can know.
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
                 "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"));
  ASSERT_OK(bench.pipeline.start(state_at(0.0, 0.0)));
  for (std::size_t i = 0; i < storage.size(); ++i) {
    bench.channel.stores[i].waypoints = storage[i].data();
    bench.channel.stores[i].capacity = kCapacity;
  }
  return client;
}

/// The verdict of the client or, if it lets the trajectory pass, of the generator's next cycle.
Verdict judge(ReferenceClient<JointSpace>& client, Trajectory<JointSpace>& trajectory) {
  std::uint32_t id = 0;
  Verdict verdict = client.send(trajectory, id);
  if (!verdict.ok()) return verdict;
  ASSERT_OK(bench.pipeline.step(state_at(0.0, 0.0)));
  Report report;
  assert_true(client.poll(report));
  assert_int_equal(report.id, id);
  return report.verdict;
}

/// As the first line of a file has it: "kVelocityLimit waypoint 2 joint 1".
Message words(const Verdict& verdict) {
  Message text(name(verdict.status));
  if (verdict.waypoint >= 0) text << " waypoint " << verdict.waypoint + 1;
  if (verdict.axis >= 0) text << " joint " << verdict.axis + 1;
  return text;
}

// Proves RG-6, RG-7.

void every_trajectory_that_breaks_a_limit_is_refused_with_its_verdict(void**) {
  ReferenceClient<JointSpace>& client = start();
  const auto refused = [&](const RefusedFile& file) {
    Trajectory<JointSpace>* trajectory = client.acquire();
    CsvError error;
    assert_non_null(trajectory);
    assert_true(read_trajectory(file.path.data(), *trajectory, error));
    return file.expects(words(judge(client, *trajectory)));
  };
  assert_true(judge_refused_files("tests/refused/admission", ".csv", refused) >= 25);
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
  trajectory.waypoints[0].time_s = 100.0;
  trajectory.waypoints[0].point.q = limits.q_max;
  trajectory.waypoints[0].point.tau = limits.tau_max;
  trajectory.waypoints[1].point.q = limits.q_max - limits.dq_max;
  trajectory.waypoints[1].time_s = 105.0;
  assert_string_equal(words(judge(client, trajectory)).c_str(), "kOk");
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_trajectory_that_breaks_a_limit_is_refused_with_its_verdict),
      cmocka_unit_test(a_count_that_is_none_or_more_than_the_store_holds_is_refused),
      cmocka_unit_test(a_number_that_is_not_finite_is_refused_wherever_it_stands),
      cmocka_unit_test(what_touches_its_limits_and_no_more_is_admitted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
