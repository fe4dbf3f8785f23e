// Tests trajectory files that are longer than the store they pass through.
#include <fcntl.h>
#include <sys/stat.h>

#include "tests/gateway/trajectory/stream_bench.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr Fields kQuintic = kVelocityField | kAccelerationField;
constexpr Fields kKinds[] = {0, kVelocityField, kQuintic};

template <class Space>
StreamBench<Space>& fresh(int which) {
  static std::array<StreamBench<Space>*, 2> benches{};
  auto& bench = benches[static_cast<std::size_t>(which)];
  delete bench;
  bench = new StreamBench<Space>;
  return *bench;
}

template <class Space>
bool same_bits(const typename Space::Point& a, const typename Space::Point& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

/// Runs a file through a store that holds it and through a window; the references are the same.
template <class Space>
void assert_same(int rows, int window) {
  StreamBench<Space>&whole = fresh<Space>(0), &streamed = fresh<Space>(1);
  assert_true(whole.open(kMostRows));
  assert_true(streamed.open(window));
  assert_false(whole.stream.longer());
  assert_true(streamed.stream.longer());
  assert_int_equal(streamed.stream.count(), rows);
  assert_true(streamed.stream.end_s() == whole.stream.end_s());
  assert_true(whole.stream.stretch() == 0.0 && streamed.stream.stretch() == 0.0);
  const int last = static_cast<int>(whole.stream.end_s() / kStreamPeriod_s) + 100;
  for (int k = 0; k < last; ++k) {
    whole.step();
    streamed.step();
    assert_true(same_bits<Space>(whole.out(), streamed.out()));
  }
  ASSERT_STATUS(whole.outcome, Outcome::kSucceeded);
  ASSERT_STATUS(streamed.outcome, Outcome::kSucceeded);
}

// Proves CSV-5.

void a_joint_file_gives_the_same_references_bit_for_bit_through_a_window(void**) {
  Random random{1};
  for (int trial = 0; trial < tries(30, 9); ++trial) {
    const Fields fields = kKinds[trial % 3];
    const int rows = fields == 0 ? 1500 + random.below(500) : 200 + random.below(1000);
    write_swing<JointSpace>(Swing(random, 0.2, fields == 0 ? 1.0 : 2.0), rows, fields);
    assert_same<JointSpace>(rows, rows / 2 - random.below(rows / 4));
  }
}

void a_task_file_gives_the_same_references_bit_for_bit_through_a_window(void**) {
  Random random{2};
  for (int trial = 0; trial < tries(30, 9); ++trial) {
    const Fields fields = kKinds[trial % 3];
    const int rows = fields == 0 ? 1500 + random.below(500) : 200 + random.below(1000);
    write_swing<TaskSpace>(Swing(random, 0.1, fields == 0 ? 1.0 : 2.0), rows, fields);
    assert_same<TaskSpace>(rows, rows / 2 - random.below(rows / 4));
  }
}

/// A file that a window slows down is passed within the time by which it is said to get longer.
void a_file_that_is_slowed_down_ends_when_it_is_said_to(void**) {
  Random random{3};
  int slowed = 0;
  for (int trial = 0; trial < 100; ++trial) {
    write_swing<JointSpace>(Swing(random, 0.8, 1.1), 400, kQuintic);
    StreamBench<JointSpace>&whole = fresh<JointSpace>(0), &streamed = fresh<JointSpace>(1);
    if (!whole.open(kMostRows) || !streamed.open(100)) continue;
    if (whole.stream.stretch() == 0.0) continue;
    ++slowed;
    for (StreamBench<JointSpace>* bench : {&whole, &streamed}) {
      for (int k = 0; k < 20000 && bench->outcome == Outcome::kStarted; ++k) bench->step();
      ASSERT_STATUS(bench->outcome, Outcome::kSucceeded);
    }
    const double said_s = streamed.stream.end_s() + streamed.stream.longer_s();
    ASSERT_NEAR(streamed.cycles * kStreamPeriod_s, said_s, 0.01 * said_s);
    ASSERT_NEAR(streamed.cycles * kStreamPeriod_s, whole.cycles * kStreamPeriod_s, 0.01 * said_s);
  }
  assert_true(slowed >= 5);
}

/// Changes one waypoint so that it must be refused.
template <class Space>
void damage(Random& random, double& t, typename Space::Point& point);
template <>
void damage<JointSpace>(Random& random, double& t, JointSpace::Point& point) {
  switch (random.below(3)) {
    case 0: point.q[random.below(kDof)] += 10.0; break;
    case 1: point.dq[random.below(kDof)] += 10.0; break;
    default: t -= 1.0;
  }
}
template <>
void damage<TaskSpace>(Random& random, double& t, TaskSpace::Point& point) {
  switch (random.below(3)) {
    case 0: point.x.p[random.below(3)] += 10.0; break;
    case 1: point.x.r.coeffs() *= 1.1; break;
    default: t -= 1.0;
  }
}

/// The verdict is that of a store that holds the file, and names the line.
template <class Space>
void assert_same_refusals(std::uint64_t seed) {
  Random random{seed};
  for (int trial = 0; trial < tries(60, 20); ++trial) {
    const int rows = 200, broken = 1 + random.below(rows - 1);
    write_swing<Space>(Swing(random, 0.1, 3.0), rows, kQuintic,
                       [&](int row, double& t, typename Space::Point& point) {
                         if (row == broken) damage<Space>(random, t, point);
                       });
    StreamBench<Space>&whole = fresh<Space>(0), &streamed = fresh<Space>(1);
    assert_false(whole.open(kMostRows, true));
    assert_false(streamed.open(60, true));
    const Verdict expected = whole.stream.refusal().verdict;
    const Verdict verdict = streamed.stream.refusal().verdict;
    ASSERT_STATUS(verdict.status, expected.status);
    assert_int_equal(verdict.waypoint, expected.waypoint);
    assert_int_equal(verdict.axis, expected.axis);
    assert_true(verdict.value == expected.value && verdict.limit == expected.limit);
    assert_int_equal(streamed.stream.refusal().line, verdict.waypoint + 2);
  }
}

// Proves CSV-6.

void a_joint_file_is_refused_before_it_moves_as_if_it_fitted(void**) {
  assert_same_refusals<JointSpace>(4);
}
void a_task_file_is_refused_before_it_moves_as_if_it_fitted(void**) {
  assert_same_refusals<TaskSpace>(5);
}

void a_row_that_cannot_be_read_is_refused_before_anything_moves(void**) {
  Random random{6};
  write_swing<JointSpace>(Swing(random, 0.1, 3.0), 200, kVelocityField);
  std::FILE* file = std::fopen(stream_file(), "a");
  std::fputs("nothing\n", file);
  std::fclose(file);
  StreamBench<JointSpace>& streamed = fresh<JointSpace>(1);
  assert_false(streamed.open(60));
  assert_string_equal(
      streamed.stream.refusal().row.message().c_str(),
      "202:1: time_s: 'nothing' is not a finite number; write a number such as -0.5");
}

void the_last_waypoint_of_a_long_file_is_at_rest(void**) {
  Random random{7};
  write_swing<JointSpace>(Swing(random, 0.1, 3.0), 200, kVelocityField,
                          [](int row, double&, JointSpace::Point& point) {
                            if (row == 199) point.dq[2] = 0.01;
                          });
  StreamBench<JointSpace>& streamed = fresh<JointSpace>(1);
  assert_false(streamed.open(60));
  ASSERT_STATUS(streamed.stream.refusal().verdict.status, Status::kNotAtRest);
  assert_int_equal(streamed.stream.refusal().line, 201);
}

void a_long_file_cannot_be_monotone(void**) {
  Random random{8};
  write_swing<JointSpace>(Swing(random, 0.1, 3.0), 200, 0);
  StreamBench<JointSpace>& streamed = fresh<JointSpace>(1);
  assert_false(streamed.open(60, false, Interpolation::kMonotone));
  ASSERT_STATUS(streamed.stream.refusal().verdict.status, Status::kNotStreamable);
}

/// Even if its size, and the time of its last change, are those of before.
void a_file_that_changes_after_it_was_judged_is_refused_on_the_way(void**) {
  for (const bool hidden : {false, true}) {
    Random random{9};
    const Swing swing(random, 0.1, 3.0);
    write_swing<JointSpace>(swing, 1000, kVelocityField);
    StreamBench<JointSpace>& streamed = fresh<JointSpace>(1);
    assert_true(streamed.open(60));
    struct stat before = {};
    assert_int_equal(stat(stream_file(), &before), 0);
    std::FILE* file = std::fopen(stream_file(), "r+");
    std::fseek(file, -16, SEEK_END);  // the last digit of the last position
    const int digit = std::fgetc(file);
    std::fseek(file, -16, SEEK_END);
    std::fputc(digit == '1' ? '2' : '1', file);
    std::fclose(file);
    const timespec times[2] = {before.st_atim, before.st_mtim};
    const timespec later[2] = {before.st_atim, {before.st_mtim.tv_sec + 1, 0}};
    assert_int_equal(utimensat(AT_FDCWD, stream_file(), hidden ? times : later, 0), 0);
    FeedResult fed = FeedResult::kAhead;
    while (fed != FeedResult::kRefused && streamed.outcome == Outcome::kStarted &&
           streamed.cycles < 20000)
      fed = streamed.step();
    ASSERT_STATUS(fed, FeedResult::kRefused);
    const std::string_view reason = streamed.stream.refusal().row.reason;
    assert_true(reason.substr(0, 16) == "the file changed");
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_joint_file_gives_the_same_references_bit_for_bit_through_a_window),
      cmocka_unit_test(a_task_file_gives_the_same_references_bit_for_bit_through_a_window),
      cmocka_unit_test(a_file_that_is_slowed_down_ends_when_it_is_said_to),
      cmocka_unit_test(a_joint_file_is_refused_before_it_moves_as_if_it_fitted),
      cmocka_unit_test(a_task_file_is_refused_before_it_moves_as_if_it_fitted),
      cmocka_unit_test(a_row_that_cannot_be_read_is_refused_before_anything_moves),
      cmocka_unit_test(the_last_waypoint_of_a_long_file_is_at_rest),
      cmocka_unit_test(a_long_file_cannot_be_monotone),
      cmocka_unit_test(a_file_that_changes_after_it_was_judged_is_refused_on_the_way),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_stream_file);
}
