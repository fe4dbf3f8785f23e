// References over the link: what is asked of a board, in order and out of order, and its answers.
#include <cmath>

#include "gateway/reference_frames.hpp"
#include "kernel/core/status.hpp"
#include "tests/hal/serial/board_bench.hpp"

namespace tactus::pil {
namespace {

using JointWaypoint = Waypoint<JointSpace>;

constexpr double kAway_rad = 0.05;

struct Sent {
  Verdict verdict;
  std::uint32_t id = 0;
};

/// A message with a payload, and the verdict and the number that its answer has.
Sent sent(BoardBench& bench, Kind kind, const ByteWriter& payload) {
  const Status status = bench.board.request(kind, payload);
  ByteReader from = bench.board.answer();
  Sent answer;
  answer.verdict = read_verdict(from);
  answer.id = from.u32();
  if (!from.done()) answer = {{status}, 0};
  return answer;
}

void begin(BoardBench& bench, const TrajectoryTerms& terms) {
  std::uint8_t bytes[128];
  ByteWriter payload(bytes, sizeof bytes);
  write_terms(payload, terms);
  ASSERT_OK(sent(bench, Kind::kTrajectory, payload).verdict.status);
}

Sent waypoint(BoardBench& bench, double time_s, double away_rad, Fields fields) {
  JointWaypoint waypoint;
  waypoint.time_s = time_s;
  waypoint.point.q = ready_pose() + JointVector::Constant(away_rad);
  std::uint8_t bytes[400];
  ByteWriter payload(bytes, sizeof bytes);
  payload.u8(1);
  write_waypoint(payload, waypoint, fields);
  return sent(bench, Kind::kWaypoints, payload);
}

Sent end(BoardBench& bench) {
  std::uint8_t nothing[1];
  return sent(bench, Kind::kEnd, ByteWriter(nothing, 0));
}

Sent control(BoardBench& bench, ControlKind kind, double rate = 1.0) {
  std::uint8_t bytes[16];
  ByteWriter payload(bytes, sizeof bytes);
  payload.u8(0);
  payload.u8(static_cast<std::uint8_t>(kind));
  payload.f64(rate);
  return sent(bench, Kind::kControl, payload);
}

/// A motion of all joints and back, in 4 s.
std::uint32_t send_motion(BoardBench& bench) {
  begin(bench, {});
  const double times_s[] = {0.0, 2.0, 4.0}, away_rad[] = {0.0, kAway_rad, 0.0};
  for (int i = 0; i < 3; ++i) {
    const Sent taken = waypoint(bench, times_s[i], away_rad[i], 0);
    ASSERT_OK(taken.verdict.status);
    assert_int_equal(taken.id, 1);
  }
  const Sent whole = end(bench);
  ASSERT_OK(whole.verdict.status);
  return whole.id;
}

/// The last report on a request that the board gives within some cycles.
Outcome last_report(BoardBench& bench, std::uint32_t id, int cycles) {
  Outcome outcome = Outcome::kScheduled;
  for (int i = 0; i < cycles; ++i) {
    ASSERT_OK(bench.step(Order::kArmed));
    if (bench.board.result().reports == 0) continue;
    ASSERT_OK(bench.board.request(Kind::kReports));
    ByteReader from = bench.board.answer();
    while (from.left() > 0) {
      const Report report = read_report(from);
      if (report.id == id) outcome = report.outcome;
    }
    assert_true(from.ok());
  }
  return outcome;
}

BoardBench& armed() {
  BoardBench& bench = fresh();
  bench.start(Pace::kLockStep);
  bench.arm(Pace::kLockStep);
  return bench;
}

// Proves BRD-5.
void a_trajectory_is_followed_and_reported(void**) {
  BoardBench& bench = armed();
  const std::uint32_t id = send_motion(bench);
  assert_true(last_report(bench, id, 2000) == Outcome::kStarted);
  const double away = (bench.plant.arm().q() - ready_pose()).cwiseAbs().maxCoeff();
  assert_true(away > 0.5 * kAway_rad && away < 1.5 * kAway_rad);
  assert_true(last_report(bench, id, 3000) == Outcome::kSucceeded);
  assert_true((bench.plant.arm().q() - ready_pose()).cwiseAbs().maxCoeff() < 0.1 * kAway_rad);
}

void a_cancel_ends_it(void**) {
  BoardBench& bench = armed();
  const std::uint32_t id = send_motion(bench);
  assert_true(last_report(bench, id, 500) == Outcome::kStarted);
  ASSERT_OK(control(bench, ControlKind::kCancel).verdict.status);
  assert_true(last_report(bench, id, 1000) == Outcome::kCanceled);
}

void a_pause_holds_it_until_it_is_resumed(void**) {
  BoardBench& bench = armed();
  const std::uint32_t id = send_motion(bench);
  assert_true(last_report(bench, id, 500) == Outcome::kStarted);
  ASSERT_OK(control(bench, ControlKind::kPause).verdict.status);
  assert_true(last_report(bench, id, 5000) == Outcome::kScheduled);  // nothing more
  ASSERT_OK(control(bench, ControlKind::kResume).verdict.status);
  assert_true(last_report(bench, id, 5000) == Outcome::kSucceeded);
}

void a_point_is_executed(void**) {
  BoardBench& bench = armed();
  TrajectoryTerms terms;
  JointWaypoint point;
  point.point.q = ready_pose() + JointVector::Constant(0.001);
  std::uint8_t bytes[400], head_bytes[100];
  ByteWriter head(head_bytes, sizeof head_bytes), payload(bytes, sizeof bytes);
  write_terms(head, terms);
  payload.u8(static_cast<std::uint8_t>(head.size()));
  payload.text({reinterpret_cast<const char*>(head.data()), head.size()});
  write_waypoint(payload, point, 0);
  const Sent answer = sent(bench, Kind::kPoint, payload);
  ASSERT_OK(answer.verdict.status);
  assert_true(last_report(bench, answer.id, 1000) == Outcome::kExecuted);
}

void a_waypoint_beyond_a_limit_is_refused_with_value_and_limit(void**) {
  BoardBench& bench = armed();
  begin(bench, {});
  ASSERT_OK(waypoint(bench, 0.0, 0.0, 0).verdict.status);
  ASSERT_OK(waypoint(bench, 2.0, 9.0, 0).verdict.status);
  const Sent refused = end(bench);
  ASSERT_STATUS(refused.verdict.status, Status::kPositionLimit);
  assert_int_equal(refused.verdict.waypoint, 1);
  assert_true(refused.verdict.value > refused.verdict.limit);
  begin(bench, {});
  ASSERT_OK(waypoint(bench, 0.0, std::nan(""), 0).verdict.status);
  ASSERT_STATUS(end(bench).verdict.status, Status::kReferenceNotFinite);
  assert_true(send_motion(bench) > 0);  // and the next is taken
}

// Proves BRD-6.
void what_comes_too_early_too_late_or_malformed_is_refused(void**) {
  BoardBench& bench = fresh();
  std::uint8_t bytes[100] = {};
  const ByteWriter nothing(bytes, 0);
  ASSERT_STATUS(bench.board.request(Kind::kEnd), Status::kNotStarted);
  bench.start(Pace::kLockStep);
  ASSERT_STATUS(bench.request(Kind::kStart, 1), Status::kNotAtRest);  // it runs
  ASSERT_STATUS(bench.load({}), Status::kNotAtRest);
  ASSERT_STATUS(end(bench).verdict.status, Status::kNothingToExtend);
  ASSERT_STATUS(waypoint(bench, 0.0, 0.0, 0).verdict.status, Status::kNothingToExtend);
  ASSERT_STATUS(bench.request(Kind::kTrajectory, 0), Status::kWireFormat);
  ASSERT_STATUS(bench.request(Kind::kPoint, 200), Status::kWireFormat);
  ASSERT_STATUS(bench.request(Kind::kControl, 0), Status::kWireFormat);
  ASSERT_STATUS(bench.request(static_cast<Kind>(29), 99), Status::kBadValue);
  ASSERT_STATUS(control(bench, static_cast<ControlKind>(17)).verdict.status, Status::kWireFormat);
  begin(bench, {});
  ASSERT_STATUS(sent(bench, Kind::kWaypoints, nothing).verdict.status, Status::kWireFormat);
  std::uint8_t half_bytes[80];
  ByteWriter half(half_bytes, sizeof half_bytes);
  half.u8(2);  // waypoints, of which there is one
  write_waypoint(half, JointWaypoint(), 0);
  const Sent none = sent(bench, Kind::kWaypoints, half);
  ASSERT_STATUS(none.verdict.status, Status::kWireFormat);
  assert_int_equal(none.id, 0);  // was taken
  bench.arm(Pace::kLockStep);
}

void references_to_a_space_that_the_pipeline_lacks_are_refused(void**) {
  BoardBench& bench = armed();
  std::uint8_t bytes[128];
  TrajectoryTerms terms;
  terms.poses = true;
  ByteWriter trajectory(bytes, sizeof bytes);
  write_terms(trajectory, terms);
  ASSERT_STATUS(sent(bench, Kind::kTrajectory, trajectory).verdict.status, Status::kNotOffered);
  ByteWriter cancel(bytes, sizeof bytes);
  cancel.u8(1);
  cancel.u8(static_cast<std::uint8_t>(ControlKind::kCancel));
  cancel.f64(1.0);
  ASSERT_STATUS(sent(bench, Kind::kControl, cancel).verdict.status, Status::kNotOffered);
}

}  // namespace
}  // namespace tactus::pil

int main() {
  using namespace tactus::pil;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_trajectory_is_followed_and_reported),
      cmocka_unit_test(a_cancel_ends_it),
      cmocka_unit_test(a_pause_holds_it_until_it_is_resumed),
      cmocka_unit_test(a_point_is_executed),
      cmocka_unit_test(a_waypoint_beyond_a_limit_is_refused_with_value_and_limit),
      cmocka_unit_test(what_comes_too_early_too_late_or_malformed_is_refused),
      cmocka_unit_test(references_to_a_space_that_the_pipeline_lacks_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
