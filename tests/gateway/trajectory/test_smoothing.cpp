// Tests positions that are smoothed: written with few digits, or measured, and what is taken as it
// is given.
#include <algorithm>
#include <cmath>

#include "tests/gateway/trajectory/stream_bench.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr SmoothingTolerance kTolerance = {0.005, 0.001};
constexpr double kPi = 3.14159265358979323846;

/// How a file is written.
struct Recording {
  double rate_hz = 1000.0;
  int decimals = 6;
  double noise = 0.0;  // standard deviation, rad or m
  Fields fields = 0;
};

double normal(Random& random) {
  const double u = random.uniform(1e-12, 1.0);
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * kPi * random.uniform(0.0, 1.0));
}

template <class Vector>
void write_rounded(std::FILE* file, const Vector& numbers, int decimals) {
  for (int i = 0; i < static_cast<int>(numbers.size()); ++i)
    std::fprintf(file, ",%.*f", decimals, numbers[i]);
}
void write_rounded(std::FILE* file, const Recording& how, const JointSpace::Point& point) {
  write_rounded(file, point.q, how.decimals);
  if (how.fields & kVelocityField) write_rounded(file, point.dq, how.decimals);
  if (how.fields & kAccelerationField) write_rounded(file, point.ddq, how.decimals);
}
void write_rounded(std::FILE* file, const Recording& how, const TaskSpace::Point& point) {
  const Eigen::Quaterniond& r = point.x.r;
  write_rounded(file, point.x.p, how.decimals);
  write_rounded(file, Eigen::Vector4d(r.w(), r.x(), r.y(), r.z()), how.decimals);
  if (how.fields & kVelocityField) write_rounded(file, point.v, how.decimals);
  if (how.fields & kAccelerationField) write_rounded(file, point.a, how.decimals);
}

void disturb(JointSpace::Point& point, Random& random, double noise) {
  for (double& q : point.q) q += noise * normal(random);
}
void disturb(TaskSpace::Point& point, Random& random, double noise) {
  Vector3 turn;
  for (int i = 0; i < 3; ++i) {
    point.x.p[i] += noise * normal(random);
    turn[i] = noise * normal(random);
  }
  point.x.r = exp_so3(turn) * point.x.r;
}

int rows_of(const Swing& swing, const Recording& how) {
  return static_cast<int>(std::ceil(swing.duration_s * how.rate_hz)) + 1;
}

/// Writes a swing from `from_s` on, which begins after `lead_s`; returns its number of rows.
template <class Space>
int record(const Swing& swing, const Recording& how, Random& random, double lead_s = 1.0,
           double from_s = 0.0) {
  std::FILE* file = std::fopen(stream_file(), "wb");
  assert_non_null(file);
  write_header(file, how.fields, Space());
  const int rows = rows_of(swing, how) - static_cast<int>(from_s * how.rate_hz);
  for (int i = 0; i < rows; ++i) {
    const double t = std::min(from_s + i / how.rate_hz, swing.duration_s);
    typename Space::Point point;
    set(swing, t, point);
    if (i == rows - 1) point = point.at_rest();
    disturb(point, random, how.noise);
    std::fprintf(file, "%.9f", lead_s + i / how.rate_hz);
    write_rounded(file, how, point);
    std::fprintf(file, "\n");
  }
  std::fclose(file);
  return rows;
}

struct Judged {
  bool accepted = false;
  SmoothingTolerance moved;
  Verdict verdict;
};

/// Judges the file, whose waypoints are then in the first store of the bench.
template <class Space>
Judged judge(StreamBench<Space>& bench, const SmoothingTolerance& tolerance, int capacity,
             Interpolation how = Interpolation::kByFields) {
  bench.channel.settings.period_s = kStreamPeriod_s;
  Trajectory<Space>& store = bench.channel.stores[0];
  store = {};
  store.waypoints = bench.waypoints.data();
  store.capacity = capacity;
  if (!bench.stream.open(stream_file(), false, 0, store)) return {};
  store.interpolation = how;
  const bool accepted = bench.stream.judge(bench.client.settings(), tolerance);
  return {accepted, bench.stream.moved(), bench.stream.refusal().verdict};
}

/// Root of the mean square of all axes.
double apart(const JointSpace::Point& a, const JointSpace::Point& b) {
  return (a.q - b.q).norm() / std::sqrt(kDof);
}
double apart(const TaskSpace::Point& a, const TaskSpace::Point& b) {
  return std::hypot((a.x.p - b.x.p).norm(), a.x.r.angularDistance(b.x.r)) / std::sqrt(6.0);
}
double rate_apart(const JointSpace::Point& a, const JointSpace::Point& b) {
  return (a.dq - b.dq).cwiseAbs().maxCoeff();
}
double rate_apart(const TaskSpace::Point& a, const TaskSpace::Point& b) {
  return (a.v - b.v).cwiseAbs().maxCoeff();
}

/// The motion that was recorded is known: what is left of the error of its positions, as a share of
/// what was written or measured, and of its velocities, rad/s or m/s.
template <class Space>
void recover(double largest, double slowest_s, Random& random, const Recording& how) {
  static StreamBench<Space> bench;
  Swing swing(random, largest, slowest_s);
  while (rows_of(swing, how) > kMostRows) swing = Swing(random, largest, slowest_s);
  const int rows = record<Space>(swing, how, random);
  const Judged judged = judge<Space>(bench, kTolerance, kMostRows);
  const double error = how.noise + 0.5 * std::pow(10.0, -how.decimals);
  assert_true(judged.accepted);
  assert_true(bench.stream.smoothing().tolerance.allows() && !bench.stream.longer());
  assert_true(bench.stream.stretch() == 0.0);
  const Trajectory<Space>& store = bench.channel.stores[0];
  assert_int_equal(store.count, rows);
  double squares = 0.0, rate = 0.0;
  for (int i = 0; i < rows; ++i) {
    typename Space::Point truth;
    set(swing, std::min(i / how.rate_hz, swing.duration_s), truth);
    const typename Space::Point point = store.at(i).point;
    squares += std::pow(apart(point, truth), 2.0);
    rate = std::max(rate, rate_apart(point, truth));
  }
  assert_true(std::sqrt(squares / rows) < 0.8 * error);
  assert_true(rate < 60.0 * error + 0.01 * kPi * largest / slowest_s);
  assert_true(store.at(rows - 1).point.standing());
}

// Proves CSV-8.

void digits_that_were_not_written_are_found_again(void**) {
  Random random{11};
  constexpr Fields kKinds[] = {0, kVelocityField | kAccelerationField};
  for (int trial = 0; trial < tries(15, 4); ++trial) {
    Recording how;
    how.fields = kKinds[trial % 2];
    how.decimals = how.fields == 0 ? 3 + random.below(6) : 3 + random.below(3);
    how.rate_hz = how.fields == 0 ? random.uniform(100.0, 500.0) : 500.0;
    recover<JointSpace>(0.2, 1.5, random, how);
    how.decimals += 1;  // a metre is more than a radian
    recover<TaskSpace>(0.05, 1.5, random, how);
  }
}

void noise_of_a_recording_is_told_from_its_motion(void**) {
  Random random{12};
  for (int trial = 0; trial < tries(15, 4); ++trial) {
    Recording how;
    how.decimals = 9;
    how.rate_hz = random.uniform(30.0, 500.0);
    how.noise = std::pow(10.0, random.uniform(-6.0, -3.0));
    recover<JointSpace>(0.2, 1.5, random, how);
    how.noise *= 0.2;
    recover<TaskSpace>(0.05, 1.5, random, how);
  }
}

/// A file of many windows, of the spline and of the store, is one motion: what is judged is sent.
void a_file_longer_than_its_store_is_smoothed_on_its_way(void**) {
  Random random{13};
  static StreamBench<JointSpace> bench;
  Recording how;
  Swing swing(random, 0.2, 3.0);
  swing.duration_s *= 3.0 / swing.swings + 1.0;
  const int rows = record<JointSpace>(swing, how, random);
  const Judged judged = judge<JointSpace>(bench, kTolerance, 1000);
  assert_true(rows > 5000 && judged.accepted && bench.stream.longer());
  assert_true(judged.moved.rad > 0.0 && judged.moved.rad < 2e-6);
  ASSERT_OK(bench.generator.start(bench.channel, bench.params, home_of(JointSpace())));
  assert_true(bench.client.send(bench.channel.stores[0], bench.id).ok());
  double worst = 0.0;
  for (int k = 0; k < 1100 + rows; ++k) {
    bench.step();
    JointSpace::Point truth;
    const double t = std::clamp((k - 1000) * kStreamPeriod_s, 0.0, swing.duration_s);
    set(swing, t, truth);
    if (k > 1000) worst = std::max(worst, apart(bench.out(), truth));
  }
  assert_true(worst < 3e-6);
  ASSERT_STATUS(bench.outcome, Outcome::kSucceeded);
  assert_true(bench.stream.moved().rad == judged.moved.rad);  // as was told before
}

/// A recording that begins in motion is run up to: on the way to it no axis leaves the range
/// between where the arm is and where the recording begins by more than the run-up takes.
template <class Space>
void run_up_to(double largest, double lead_s, Random& random) {
  static StreamBench<Space> bench;
  const Swing swing(random, largest, 3.0);
  Recording how;
  how.rate_hz = 100.0;
  const int rows = record<Space>(swing, how, random, lead_s, 0.3 * swing.duration_s);
  assert_true(judge<Space>(bench, kTolerance, kMostRows).accepted);
  assert_int_equal(bench.stream.count(), rows);  // those of the file, and their times
  assert_true(std::abs(bench.stream.time_s(0) - lead_s) < 1e-6);
  const typename Space::Point home = home_of(Space());
  typename Space::Point first;
  set(swing, 0.3 * swing.duration_s, first);
  const auto to = Space::difference(first, home).x;
  ASSERT_OK(bench.generator.start(bench.channel, bench.params, home));
  assert_true(bench.client.send(bench.channel.stores[0], bench.id).ok());
  double beyond = 0.0;
  for (int k = 0; k < lead_s / kStreamPeriod_s; ++k) {
    bench.step();
    const auto x = Space::difference(bench.out(), home).x;
    beyond =
        std::max({beyond, (x - to.cwiseMax(0.0)).maxCoeff(), (to.cwiseMin(0.0) - x).maxCoeff()});
  }
  assert_true(beyond < 0.5 * largest);
  assert_true(apart(bench.out(), first) < 0.01 * largest);
  for (int k = 0; k < (swing.duration_s + 1.0) / kStreamPeriod_s; ++k) bench.step();
  ASSERT_STATUS(bench.outcome, Outcome::kSucceeded);
}

void the_way_to_a_recording_that_begins_in_motion_does_not_swing_out(void**) {
  Random random{17};
  for (const double lead_s : {1.0, 5.0, 20.0, 60.0}) {
    run_up_to<JointSpace>(0.2, lead_s, random);
    run_up_to<TaskSpace>(0.1, lead_s, random);
  }
}

/// Corners that are meant, an interpolation that is asked for, no tolerance, noise beyond it.
void what_is_not_near_a_smooth_curve_is_taken_or_refused_as_given(void**) {
  Random random{14};
  static StreamBench<JointSpace> bench;
  const Swing slow(random, 0.005, 2.0);
  Recording how;
  how.rate_hz = 10.0;
  record<JointSpace>(slow, how, random);
  assert_true(judge<JointSpace>(bench, {}, kMostRows).accepted &&
              !bench.stream.smoothing().tolerance.allows());
  const Interpolation linear = Interpolation::kLinear;
  assert_true(judge<JointSpace>(bench, kTolerance, kMostRows, linear).accepted &&
              !bench.stream.smoothing().tolerance.allows());
  std::FILE* file = std::fopen(stream_file(), "wb");  // a line there and back
  assert_non_null(file);
  write_header(file, 0, JointSpace());
  JointSpace::Point point = home_of(JointSpace());
  for (int i = 0; i < 30; ++i) {
    write_row(file, 0, 1.0 + 0.5 * i, point);
    point.q[0] += i % 10 < 5 ? 0.05 : -0.05;
  }
  std::fclose(file);
  assert_true(judge<JointSpace>(bench, kTolerance, kMostRows).accepted &&
              !bench.stream.smoothing().tolerance.allows());
  how = {500.0, 9, 0.005, 0};
  record<JointSpace>(slow, how, random);
  assert_false(judge<JointSpace>(bench, {}, kMostRows).accepted);
  assert_false(judge<JointSpace>(bench, {0.002, 0.002}, kMostRows).accepted);
  assert_true(judge<JointSpace>(bench, {0.03, 0.03}, kMostRows).accepted);
}

/// Joint 1 goes to the end of its range, at two rows; between them the curve would pass it.
void a_recording_that_touches_the_end_of_a_range_is_taken_as_given(void**) {
  static StreamBench<JointSpace> bench;
  JointSpace::Point point = home_of(JointSpace());
  const double end = bench.client.settings().limits.q_max[0];
  std::FILE* file = std::fopen(stream_file(), "wb");
  assert_non_null(file);
  write_header(file, 0, JointSpace());
  for (int i = 0; i <= 400; ++i) {
    const auto bump = [](double rows) { return 0.2 * std::pow(std::cos(kPi * rows / 400.0), 2.0); };
    point.q[0] = std::min(end + bump(i - 200.5) - bump(0.5), end);
    write_row(file, 0, 4.0 + 0.01 * i, point);
  }
  std::fclose(file);
  assert_true(judge<JointSpace>(bench, kTolerance, kMostRows).accepted);
  assert_false(bench.stream.smoothing().tolerance.allows());
}

/// Of printf, by hand.
void digits_are_those_that_were_written(void**) {
  Digits f, g, none;
  for (const char* number : {"0.785398", "-2.356194", "12.000000"}) f.note(number);
  assert_true(std::abs(f.half_unit(-2.356194) - 0.5e-6) < 1e-12);
  assert_true(std::abs(f.half_unit(0.0) - 0.5e-6) < 1e-12);
  for (const char* number : {"0.785398", "-2.35619", "1.5e-05", "120"}) g.note(number);
  assert_true(std::abs(g.half_unit(-2.35619) - 0.5e-5) < 1e-12);
  assert_true(std::abs(g.half_unit(120.0) - 0.5e-3) < 1e-12);
  for (const char* number : {"0.78539816339744828", "1"}) none.note(number);
  assert_true(none.half_unit(1.0) < 1e-15);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(digits_that_were_not_written_are_found_again),
      cmocka_unit_test(noise_of_a_recording_is_told_from_its_motion),
      cmocka_unit_test(a_file_longer_than_its_store_is_smoothed_on_its_way),
      cmocka_unit_test(the_way_to_a_recording_that_begins_in_motion_does_not_swing_out),
      cmocka_unit_test(what_is_not_near_a_smooth_curve_is_taken_or_refused_as_given),
      cmocka_unit_test(a_recording_that_touches_the_end_of_a_range_is_taken_as_given),
      cmocka_unit_test(digits_are_those_that_were_written),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_stream_file);
}
