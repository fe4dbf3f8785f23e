// What bounds points: max_step, a step that is refused, the end of a range, and where they end.
// Every cycle is judged by the oracle of motions as well.
#include "kernel/reference/space/judge_channels.hpp"
#include "tests/reference/motion/checked_motion.hpp"
#include "tests/streams/chunk_bench.hpp"
#include "tests/support/random.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

/// Largest velocity of the last period, as a share of its limit.
template <class Space>
double share_of_limits(const CheckedMotion<Space>& bench, const typename Space::Point& before) {
  const auto peaks = Space::peaks(bench.channel.settings.limits);
  const auto rates = Space::secant(before, bench.out(), bench.period_s);
  double most = 0.0;
  for (std::size_t c = 0; c < peaks.v.size(); ++c)
    most =
        std::max(most, length<Space::kChannelSize>(&rates[Space::kChannelSize * c]) / peaks.v[c]);
  return most;
}

template <class Space>
Report answer(CheckedMotion<Space>& bench, const typename Space::Point& point) {
  const std::uint32_t id = bench.send(point);
  assert_int_not_equal(id, 0);
  bench.cycle();
  return bench.report_of(id);
}

template <class Space>
void refuses_beyond_the_step(OnlineMode online) {
  CheckedMotion<Space> bench(1e-3, online);
  bench.params.bounds.max_step = 0.1;
  ASSERT_OK(bench.start(bench.home));
  const Report report = answer(bench, moved_by(bench.home, 0.1001));
  ASSERT_STATUS(report.outcome, Outcome::kRefused);
  ASSERT_STATUS(report.verdict.status, Status::kPointStep);
  ASSERT_NEAR(report.verdict.value, 0.1001, 1e-9);
  ASSERT_NEAR(report.verdict.limit, 0.1, 1e-8);
  assert_true(Space::difference(bench.out(), bench.home).zero());
  if (online != OnlineMode::kLimit) return;
  ASSERT_STATUS(answer(bench, moved_by(bench.home, 0.0999)).outcome, Outcome::kExecuted);
}

// Proves RG-33.

void a_point_beyond_max_step_is_refused_in_every_mode(void**) {
  for (const OnlineMode online : {OnlineMode::kForward, OnlineMode::kLimit, OnlineMode::kRefuse}) {
    refuses_beyond_the_step<JointSpace>(online);
    refuses_beyond_the_step<TaskSpace>(online);
  }
}

/// A ramp of 0.2 rad/s steps by 0.02 rad, goes on, and ends: the step is refused, its successors
/// are not, and the reference rests where they end.
template <class Space>
void refuses_one_step() {
  CheckedMotion<Space> bench(1e-3, OnlineMode::kRefuse);
  bench.oracle.forget();
  int refused = 0;
  typename Space::Point sent;
  for (int k = 1; k <= 1000; ++k) {
    sent = moved_by(bench.home, 2e-4 * std::min(k, 600) + (k > 100 ? 0.02 : 0.0));
    const typename Space::Point before = bench.out();
    const std::uint32_t id = bench.send(sent);
    ASSERT_OK(bench.step());
    refused += bench.report_of(id).outcome == Outcome::kRefused ? 1 : 0;
    assert_true(share_of_limits(bench, before) <= 1.0 + 1e-9);
  }
  assert_int_equal(refused, 1);
  ASSERT_NEAR(Space::difference(bench.out(), sent).x.norm(), 0.0, 1e-5);
}

void a_refused_step_does_not_refuse_its_successors(void**) {
  refuses_one_step<JointSpace>();
  refuses_one_step<TaskSpace>();
}

/// A point that is far from those before and after it is never gone to, whether they give
/// velocities or not.
void leaves_out_outliers(double velocity) {
  CheckedJoints bench(1e-3, OnlineMode::kRefuse);
  for (int k = 1; k <= 200; ++k) {
    JointSpace::Point sent = moved_by(bench.home, k % 50 == 0 ? 0.3 : 1e-4 * k);
    sent.dq[0] = velocity;
    const std::uint32_t id = bench.send(sent);
    ASSERT_OK(bench.step());
    const bool outlier = k % 50 == 0;
    ASSERT_STATUS(bench.report_of(id).outcome, outlier ? Outcome::kRefused : Outcome::kExecuted);
    if (!outlier) assert_true(JointSpace::difference(bench.out(), sent).zero());
  }
}

void a_single_outlier_is_left_out(void**) {
  leaves_out_outliers(0.0);
  leaves_out_outliers(0.1);
}

// Proves RG-34.

/// A leader with more range: its joint goes 0.08 rad beyond the end of the follower's and back.
void points_beyond_a_range_are_held_at_its_end_and_told_once(void**) {
  CheckedJoints bench;
  const double end = bench.channel.settings.limits.q_max[0];
  int told = 0;
  for (int k = 0; k < bench.cycles(8.0); ++k) {
    const double t = bench.generator.time_s();
    JointSpace::Point point = bench.home;
    point.q[0] = end - 0.3 + 0.38 * std::sin(0.785 * t);
    if (k % 10 == 0) assert_int_not_equal(bench.send(point), 0);
    bench.cycle();
    Report report;
    while (bench.client.poll(report)) {
      ASSERT_STATUS(report.outcome, Outcome::kExecuted);
      if (report.verdict.ok()) continue;
      ++told;
      ASSERT_STATUS(report.verdict.status, Status::kSaturated);
      ASSERT_NEAR(report.verdict.limit, end, 0.0);
    }
  }
  assert_int_equal(told, 1);
}

/// Beyond what counts as a little, not finite, or where the sender keeps the limits: refused.
void what_is_far_beyond_a_range_is_refused(void**) {
  const auto beyond = [](CheckedJoints& bench, double by) {
    JointSpace::Point point = bench.home;
    point.q[2] = bench.channel.settings.limits.q_min[2] - by;
    std::uint32_t id = 0;
    const Verdict verdict = bench.client.send(point, id);
    if (!verdict.ok()) return verdict.status;
    static_cast<void>(bench.step());
    return bench.report_of(id).verdict.status;
  };
  CheckedJoints limits, forwards(1e-3, OnlineMode::kForward);
  ASSERT_STATUS(beyond(limits, kMostSaturated + 1e-6), Status::kPositionLimit);
  ASSERT_STATUS(beyond(limits, kInfinity), Status::kReferenceNotFinite);
  ASSERT_STATUS(beyond(limits, std::nan("")), Status::kReferenceNotFinite);
  ASSERT_STATUS(beyond(limits, kMostSaturated), Status::kSaturated);
  ASSERT_STATUS(beyond(forwards, 1e-3), Status::kPositionLimit);
}

/// Chunks likewise: those of a policy whose targets pass the end of a range.
void chunks_beyond_a_range_are_held_at_its_end_and_told_once(void**) {
  CheckedJoints bench;
  static Chunk<JointSpace> chunk;
  chunk = {};
  const double end = bench.channel.settings.limits.q_max[1];
  int told = 0;
  double highest = -kInfinity;
  for (int k = 0; k < bench.cycles(6.0); ++k) {
    const double now = bench.generator.time_s();
    if (k % 250 == 0) {
      chunk.count = 0;
      ++chunk.sequence;
      for (int i = 1; i <= 10; ++i) {
        JointSpace::Point point = bench.home;
        const double x = std::min((now + 0.05 * i) / 3.0, 1.0);
        point.q[1] += (end + 0.09 - bench.home.q[1]) * x * x * (3.0 - 2.0 * x);
        chunk.add(now + 0.05 * i, point);
      }
      std::uint32_t id = 0;
      ASSERT_STATUS(bench.client.send(chunk, id).status, Status::kOk);
    }
    bench.cycle();
    highest = std::max(highest, bench.out().q[1]);
    Report report;
    while (bench.client.poll(report)) told += report.verdict.status == Status::kSaturated ? 1 : 0;
  }
  assert_int_equal(told, 1);
  assert_true(highest <= end && highest >= end - 1e-3);
}

/// The client does not know where the frame is: the generator judges where its targets are.
void chunks_in_a_frame_are_judged_where_the_frame_is(void**) {
  static Chunk<TaskSpace> chunk;
  constexpr Status kSeen[] = {Status::kOk, Status::kSaturated, Status::kWorkspace,
                              Status::kWorkspace};
  constexpr double kBeyond[] = {-0.01, 0.09, 0.11, 100.0};
  for (std::size_t i = 0; i < std::size(kBeyond); ++i) {
    CheckedTip bench;
    const double end = bench.channel.settings.limits.p_max[0] = bench.home.x.p[0] + 0.05;
    const Pose frame = {{0.0, 0.0, 1.0}, exp_so3({0.0, 0.0, 1.5})};
    chunk = {};
    chunk.header.motion = &frame;
    for (int k = 1; k <= 4; ++k) {
      Pose target = bench.home.x;
      target.p[0] = k < 4 ? target.p[0] : end + kBeyond[i];
      const Eigen::Quaterniond back = frame.r.conjugate();
      chunk.add(k < 4 ? k : 200.0, {{back * (target.p - frame.p), back * target.r}});
    }
    std::uint32_t id = 0;
    ASSERT_STATUS(bench.client.send(chunk, id).status, Status::kOk);
    bench.cycle();
    const Report report = bench.report_of(id);
    ASSERT_STATUS(report.verdict.status, kSeen[i]);
    ASSERT_STATUS(report.outcome, i < 2 ? Outcome::kExecuted : Outcome::kRefused);
    bench.run(6.0);
    assert_true(bench.out().x.p[0] <= end + 1e-9);
  }
}

/// Points with velocities, points without, cancels and waits in any order, then one point.
template <class Space>
void ends_at_the_last_point(Random& random) {
  CheckedMotion<Space> bench;
  ASSERT_OK(bench.start(bench.home));
  std::uint32_t id = 0;
  for (int n = 1 + random.below(6); n > 0; --n) {
    typename Space::Point point = moved_by(bench.home, random.uniform(-0.2, 0.2));
    if (random.below(3) > 0) Space::rates(point)[1] = random.uniform(-0.5, 0.5);
    assert_int_not_equal(bench.send(point), 0);
    bench.run(random.uniform(0.001, 0.15));
    if (random.below(2) == 0) static_cast<void>(bench.client.cancel(id));
    bench.run(random.uniform(0.001, 0.15));
    bench.report_of(id);
  }
  const typename Space::Point last = moved_by(bench.home, random.uniform(-0.2, 0.2));
  assert_int_not_equal(bench.send(last), 0);
  bench.run(2.0);
  ASSERT_NEAR(Space::difference(bench.out(), last).x.norm(), 0.0, 1e-9);
}

// Proves RG-35.

void a_point_without_a_velocity_is_where_the_reference_rests_whatever_came_before(void**) {
  Random random{5};
  for (int trial = trials(200); trial > 0; --trial) {
    ends_at_the_last_point<JointSpace>(random);
    ends_at_the_last_point<TaskSpace>(random);
  }
}

void a_canceled_point_has_no_part_in_the_next(void**) {
  CheckedJoints canceled, fresh;
  JointSpace::Point point = canceled.home;
  ASSERT_OK(canceled.start(point));
  point.dq[0] = 0.1;
  std::uint32_t id = canceled.send(point);
  canceled.run(0.02);
  ASSERT_OK(canceled.client.cancel(id).status);
  canceled.run(0.15);
  assert_true(canceled.out().standing());
  ASSERT_OK(fresh.start(canceled.out()));
  point.dq[0] = 0.3;
  for (CheckedJoints* bench : {&canceled, &fresh}) assert_int_not_equal(bench->send(point), 0);
  for (int k = 0; k < 400; ++k) {
    canceled.cycle();
    fresh.cycle();
    ASSERT_NEAR(canceled.out().q[0], fresh.out().q[0], 1e-9);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_point_beyond_max_step_is_refused_in_every_mode),
      cmocka_unit_test(a_refused_step_does_not_refuse_its_successors),
      cmocka_unit_test(a_single_outlier_is_left_out),
      cmocka_unit_test(points_beyond_a_range_are_held_at_its_end_and_told_once),
      cmocka_unit_test(what_is_far_beyond_a_range_is_refused),
      cmocka_unit_test(chunks_beyond_a_range_are_held_at_its_end_and_told_once),
      cmocka_unit_test(chunks_in_a_frame_are_judged_where_the_frame_is),
      cmocka_unit_test(
          a_point_without_a_velocity_is_where_the_reference_rests_whatever_came_before),
      cmocka_unit_test(a_canceled_point_has_no_part_in_the_next),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
