// Judging against the limits of the tool tip: no segment passes that exceeds one in dense samples,
// and every refusal gives code, axis, value and limit.
#include <algorithm>

#include "kernel/reference/space/limit_check.hpp"
#include "kernel/reference/space/vector_bounds.hpp"
#include "tests/reference/space/task_cases.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

const TaskLimits kLimits;
const double kNaN = std::nan("");
constexpr int kSegments = tries(6000, 1200);

void assert_refused(const Verdict& verdict, Status status, int axis, double value, double limit) {
  ASSERT_STATUS(verdict.status, status);
  assert_int_equal(verdict.axis, axis);
  ASSERT_NEAR(verdict.value, value, 1e-12);
  ASSERT_NEAR(verdict.limit, limit, 1e-12);
}

/// Judges a segment against `share` of the limits of acceleration and jerk.
Verdict judge(const TaskSegment& segment, const TaskLimits& limits, double share) {
  const TaskSpace::Peaks most = TaskSpace::peaks(limits).reserved(share);
  const TaskSpace::Measure measure = TaskSpace::measure(segment, limits, most);
  const Verdict verdict = TaskSpace::judge_room(measure, limits, TaskPoint());
  return verdict.ok() ? judge(measure.peaks, most, TaskSpace::kChannelSize) : verdict;
}

/// The largest values of the limited quantities, sampled at many times.
struct Sampled {
  double v = 0.0, a = 0.0, j = 0.0, w = 0.0, alpha = 0.0, dalpha = 0.0, outside = 0.0;

  explicit Sampled(const TaskSegment& segment) {
    constexpr int kSamples = 200;
    const VectorPolynomial jerk = segment.translation().derivative().derivative().derivative();
    for (int k = 0; k <= kSamples; ++k) {
      const double t = segment.duration() * k / kSamples;
      const TaskPoint now = segment.at(t);
      v = std::max(v, now.v.head<3>().norm());
      w = std::max(w, now.v.tail<3>().norm());
      a = std::max(a, now.a.head<3>().norm());
      alpha = std::max(alpha, now.a.tail<3>().norm());
      j = std::max(j, jerk.at(t).norm());
      outside = std::max(
          {outside, (now.x.p - kLimits.p_max).maxCoeff(), (kLimits.p_min - now.x.p).maxCoeff()});
    }
    const double T = segment.duration(), h = 0.01 / std::max({w, std::sqrt(alpha), 20.0 / T});
    const auto alpha_at = [&](double t) -> Vector3 { return segment.at(t).a.tail<3>(); };
    for (int k = 0; k <= kSamples; ++k) {
      const double t = 4.0 * h + (T - 8.0 * h) * k / kSamples;
      const auto beside = [&](double dt) { return alpha_at(t + dt); };
      dalpha = std::max(dalpha, first_derivative(beside, h).norm());
    }
  }
  bool within(const TaskLimits& limits, double share) const {
    constexpr double k = 1.0 + 1e-8;
    return v <= k * limits.v_max && w <= k * limits.w_max && a <= k * share * limits.a_max &&
           alpha <= k * share * limits.alpha_max && j <= k * share * limits.j_max &&
           dalpha <= k * share * limits.dalpha_max && outside <= 1e-8;
  }
  /// Returns the sampled value of the quantity that a verdict is about.
  double of(const Verdict& verdict) const {
    const bool rotation = verdict.axis == 3;
    return verdict.status == Status::kVelocityLimit       ? rotation ? w : v
           : verdict.status == Status::kAccelerationLimit ? rotation ? alpha : a
           : rotation                                     ? dalpha
                                                          : j;
  }
};

/// Returns ends near the limits, so that about half of the segments keep them.
TaskEnds close_ends(RandomVectors& random, int kind) {
  TaskEnds ends = task_ends(random, 6 + kind % 2, random.between(0.0, 3.0));
  const double shorter = random.between(0.1, 1.0);
  ends.to.x.p = ends.from.x.p + shorter * (ends.to.x.p - ends.from.x.p);
  ends.to.x.r = ends.from.x.r.slerp(shorter, ends.to.x.r);
  ends.T *= random.between(0.3, 3.0);
  for (TaskPoint* point : {&ends.from, &ends.to}) point->x.p *= 2.0 * random.between(0.5, 1.0);
  return ends;
}

/// Returns the robot's limits, or limits of which only one is tight.
TaskLimits limits_of(int i) {
  constexpr double TaskLimits::*kOnes[] = {&TaskLimits::v_max,     &TaskLimits::a_max,
                                           &TaskLimits::j_max,     &TaskLimits::w_max,
                                           &TaskLimits::alpha_max, &TaskLimits::dalpha_max};
  const int one = i % 7;
  if (one == 6) return kLimits;
  TaskLimits limits = kLimits;
  for (double TaskLimits::*each : kOnes) limits.*each *= 1e3;
  limits.*kOnes[one] = one == 2 || one == 5 ? 100.0 : 1e-3 * limits.*kOnes[one];
  return limits;
}

// Proves RG-6.

void no_segment_is_accepted_that_leaves_a_limit_anywhere(void**) {
  RandomVectors random;
  int accepted = 0;
  for (int i = 0; i < kSegments; ++i) {
    const TaskSegment segment = close_ends(random, i).join(kJoins[static_cast<std::size_t>(i % 3)]);
    const double share = i % 2 == 0 ? 1.0 : 0.9;
    const TaskLimits limits = limits_of(i / 7);
    if (!judge(segment, limits, share).ok()) continue;
    ++accepted;
    assert_true(Sampled(segment).within(limits, share));
  }
  print_message("%d of %d segments accepted\n", accepted, kSegments);
  assert_true(accepted > kSegments / 6 && accepted < kSegments * 5 / 6);
}

void a_refused_segment_is_hardly_below_the_limit(void**) {
  RandomVectors random;
  double loosest[2][3] = {};  // by vector and derivative
  for (int i = 0; i < kSegments; ++i) {
    const TaskSegment segment = close_ends(random, i).join(kJoins[static_cast<std::size_t>(i % 3)]);
    const Verdict verdict = judge(segment, limits_of(i / 7), 1.0);
    if (verdict.ok() || verdict.status == Status::kWorkspace) continue;
    const double seen = Sampled(segment).of(verdict);
    assert_true(verdict.value > verdict.limit && seen <= verdict.value * (1.0 + 1e-9));
    double& worst = loosest[verdict.axis / 3][verdict.status == Status::kVelocityLimit       ? 0
                                              : verdict.status == Status::kAccelerationLimit ? 1
                                                                                             : 2];
    worst = std::max(worst, verdict.value / seen);
  }
  print_message(
      "at most what occurs times: %.4f (v) %.4f (a) %.4f (j) %.4f (w) %.4f (alpha) %.4f (jerk)\n",
      loosest[0][0], loosest[0][1], loosest[0][2], loosest[1][0], loosest[1][1], loosest[1][2]);
  for (const double looseness : {loosest[0][0], loosest[0][1], loosest[0][2], loosest[1][0]})
    assert_true(looseness > 1.0 && looseness < 1.03);
  assert_true(loosest[1][1] > 1.0 && loosest[1][1] < 1.1);
  assert_true(loosest[1][2] > 1.0 && loosest[1][2] < 1.15);
}

void the_bounds_hold_where_no_time_is_looked_at(void**) {
  // One derivative is 1 - (t - s)^2 on every axis, largest at s, between two of the times.
  const double s = 33.0 / 64.0;
  VectorPolynomial p, integral;
  p.c[0].setConstant(1.0 - s * s);
  p.c[1].setConstant(2.0 * s);
  p.c[2].setConstant(-1.0);
  for (int order = 1; order <= 3; ++order) {
    for (std::size_t k = 5; k > 0; --k) integral.c[k] = p.c[k - 1] / static_cast<double>(k);
    p = integral;
    const VectorBounds most = translation_bounds(p, 1.0);
    const double largest = order == 1 ? most.v : order == 2 ? most.a : most.j;
    assert_true(largest >= std::sqrt(3.0) && largest < std::sqrt(3.0) * 1.001);
  }
}

void a_limit_reached_exactly_passes_and_a_little_more_does_not(void**) {
  TaskEnds ends;
  ends.to.x.p = kLimits.v_max * Vector3(0.6, 0.0, 0.8);
  assert_true(judge(ends.join(Interpolation::kLinear), kLimits, 1.0).ok());
  ends.to.x.p *= 1.0 + 1e-6;
  assert_refused(judge(ends.join(Interpolation::kLinear), kLimits, 1.0), Status::kVelocityLimit, 0,
                 kLimits.v_max * (1.0 + 1e-6), kLimits.v_max);
  ends.to.x = {Vector3::Zero(), exp_so3({0.0, 1.0001 * kLimits.w_max, 0.0})};
  assert_refused(judge(ends.join(Interpolation::kLinear), kLimits, 1.0), Status::kVelocityLimit, 3,
                 1.0001 * kLimits.w_max, kLimits.w_max);
}

void acceleration_and_jerk_are_judged_against_their_share(void**) {
  TaskEnds ends;  // from rest to rest over 1 m in T: peaks 5.7735 / T^2 and 60 / T^3
  ends.to.x.p = {1.0, 0.0, 0.0};
  ends.T = std::sqrt(5.7735 / 12.0);
  TaskLimits limits = kLimits;
  limits.v_max = 3.0;
  const TaskSegment segment = ends.join(Interpolation::kQuintic);
  assert_true(judge(segment, limits, 1.0).ok());
  const Verdict verdict = judge(segment, limits, 0.9);
  ASSERT_STATUS(verdict.status, Status::kAccelerationLimit);
  ASSERT_NEAR(verdict.limit, 0.9 * limits.a_max, 1e-12);
  ASSERT_NEAR(verdict.value, 12.0, 0.2);
  limits.j_max = 190.0;
  assert_true(judge(segment, limits, 1.0).ok());
  assert_true(judge(segment, limits, 0.93).status == Status::kJerkLimit);
}

void a_segment_that_leaves_the_workspace_between_its_ends_is_refused(void**) {
  TaskEnds ends;
  ends.from.x.p = ends.to.x.p = {0.0, 1.95, 0.0};
  ends.from.v[1] = 0.5;
  ends.to.v[1] = -0.5;
  // The cubic rises by v T / 4 in the middle.
  assert_refused(judge(ends.join(Interpolation::kCubic), kLimits, 1.0), Status::kWorkspace, 1,
                 1.95 + 0.125, kLimits.p_max[1]);
}

void what_a_segment_takes_is_what_occurs_on_it_or_more(void**) {
  RandomVectors random;
  for (int i = 0; i < kSegments / 3; ++i) {
    const TaskSegment segment = close_ends(random, i).join(kJoins[static_cast<std::size_t>(i % 3)]);
    const TaskSpace::Peaks taken =
        TaskSpace::measure(segment, kLimits, TaskSpace::peaks(kLimits)).peaks;
    const Sampled most(segment);
    const auto covers = [](double bound, double value) {
      return bound * (1.0 + 1e-9) + 1e-8 >= value;
    };
    assert_true(covers(taken.v[0], most.v) && covers(taken.v[1], most.w));
    assert_true(covers(taken.a[0], most.a) && covers(taken.a[1], most.alpha));
    assert_true(covers(taken.j[0], most.j) && covers(taken.j[1], most.dalpha));
  }
}

// Proves RG-9.

void a_segment_with_nan_is_refused(void**) {
  for (int i = 0; i < 19; ++i) {
    TaskEnds ends;
    TaskPoint& point = i % 2 == 0 ? ends.from : ends.to;
    (i < 3    ? point.x.p[i]
     : i < 7  ? point.x.r.coeffs()[i - 3]
     : i < 13 ? point.v[i - 7]
              : point.a[i - 13]) = kNaN;
    assert_false(judge(ends.join(Interpolation::kQuintic), kLimits, 1.0).ok());
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_segment_is_accepted_that_leaves_a_limit_anywhere),
      cmocka_unit_test(a_refused_segment_is_hardly_below_the_limit),
      cmocka_unit_test(the_bounds_hold_where_no_time_is_looked_at),
      cmocka_unit_test(a_limit_reached_exactly_passes_and_a_little_more_does_not),
      cmocka_unit_test(acceleration_and_jerk_are_judged_against_their_share),
      cmocka_unit_test(a_segment_that_leaves_the_workspace_between_its_ends_is_refused),
      cmocka_unit_test(what_a_segment_takes_is_what_occurs_on_it_or_more),
      cmocka_unit_test(a_segment_with_nan_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
