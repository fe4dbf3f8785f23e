// Cartesian pose control whose reference rests: a tip that leaves it is found, one that stands or
// comes nearer is not.
#include <cmath>

#include "tests/control/pose_bench.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kSettles_s = 10.0, kMost = 0.05;  // m, and rad
const Vector3 kNone = Vector3::Zero();

PoseBench& fresh(double dt_s = 1e-3) {
  static PoseBench* present = nullptr;
  delete present;
  PoseBench& bench = *(present = new PoseBench);
  bench.dt_s = dt_s;
  ASSERT_OK(bench.start(regular(0)));
  return bench;
}

/// Puts the measured tip `way_m`, `turn_rad` from the reference for a cycle.
Status measured(PoseBench& bench, const Vector3& way_m, const Vector3& turn_rad) {
  bench.x.p = bench.x_d.p + way_m;
  bench.x.r = exp_so3(turn_rad) * bench.x_d.r;
  return bench.law.step(bench.dt_s);
}

/// Swings the tip about the reference until that is found, or for `time_s`. Returns the time.
double swing(PoseBench& bench, const Vector3& way_m, const Vector3& turn_rad, double hertz,
             double time_s) {
  for (double t = 0.0; t < time_s; t += bench.dt_s) {
    const double share = std::sin(2.0 * M_PI * hertz * t);
    const Status status = measured(bench, share * way_m, share * turn_rad);
    if (status == Status::kOk) continue;
    ASSERT_STATUS(status, Status::kPathTolerance);
    const Verdict held = bench.law.held();
    ASSERT_STATUS(held.status, status);
    assert_int_equal(held.axis, way_m.isZero() ? 3 : 0);
    assert_true(held.value > held.limit && held.limit == kMost);
    return t;
  }
  return kInfinity;
}

// Proves CP-13.

void a_swing_beyond_the_tolerance_is_found_within_half_a_swing(void**) {
  Random random{5};
  RandomVectors vectors;
  for (int i = 0; i < 40; ++i) {
    PoseBench& bench = fresh();
    const double share = random.uniform(0.3, 2.0), hertz = random.uniform(0.5, 8.0);
    const Vector3 way = share * kMost * vectors.axis();
    const Vector3 turn = share * kMost * vectors.axis();
    const bool turns = i % 2 == 0;
    const double found_s =
        swing(bench, turns ? kNone : way, turns ? turn : kNone, hertz, kSettles_s + 3.0);
    if (std::abs(share - 1.0) < 0.01) continue;
    assert_true(std::isfinite(found_s) == (share > 1.0));
    if (share > 1.0)
      assert_true(found_s > kSettles_s - 2e-3 && found_s <= kSettles_s + 1.0 / hertz);
  }
}

/// Gains that are too high for measurements that are late by five periods: the tip swings by 2.7
/// mm, as the acceleration of the joints bounds what is corrected.
void a_loop_that_swings_by_itself_is_stopped(void**) {
  for (const double gain : {60.0, 10.0}) {
    PoseBench& bench = fresh(8e-3);
    bench.law.params.position_gain.setConstant(gain);
    bench.law.params.rotation_gain.setConstant(gain);
    bench.law.params.hold_tolerance = 0.001;
    bench.delay = 4;
    ASSERT_OK(bench.start(regular(0)));
    bench.x_d.p.x() += 0.01;
    const Status status = bench.run(12.0);
    ASSERT_STATUS(status, gain > 10.0 ? Status::kPathTolerance : Status::kOk);
  }
}

/// The error of a tip that circles does not grow.
void a_tip_that_circles_is_found(void**) {
  PoseBench& bench = fresh();
  Status status = Status::kOk;
  double t = 0.0;
  for (; status == Status::kOk && t < 2.0 * kSettles_s; t += bench.dt_s)
    status = measured(bench, 0.06 * Vector3(std::cos(9.0 * t), 0.0, std::sin(9.0 * t)), kNone);
  ASSERT_STATUS(status, Status::kPathTolerance);
  assert_true(t > kSettles_s && t < kSettles_s + 0.4);
  ASSERT_NEAR(bench.law.held().value, 0.06, 0.01);  // from the mean of a circle, its centre
}

void a_reference_that_moves_in_time_is_not_refused(void**) {
  PoseBench& bench = fresh();
  for (int i = 0; i < 4; ++i) {
    bench.x_d.p.y() += i % 2 == 0 ? 0.02 : -0.02;
    assert_true(std::isinf(swing(bench, {0.1, 0.0, 0.0}, kNone, 3.0, 0.9 * kSettles_s)));
  }
}

void a_tip_that_stands_out_of_reach_or_comes_nearer_is_not_refused(void**) {
  PoseBench& bench = fresh();
  Random random{6};
  for (int k = 0; k < 25'000; ++k) {
    const double way_m = 0.6 - 1e-5 * k + random.uniform(-0.02, 0.02), turn_rad = 1e-5 * k;
    ASSERT_OK(measured(bench, {0.0, way_m, 0.0},
                       1.5 * Vector3(std::sin(turn_rad), 0.0, std::cos(turn_rad))));
  }
}

/// What a leader sends is never quite the same.
void noise_of_a_reference_hides_no_swing(void**) {
  PoseBench& bench = fresh();
  Random random{7};
  double time_s = 0.0, found_s = kInfinity;
  for (; std::isinf(found_s) && time_s < 2.0 * kSettles_s; time_s += 0.5) {
    bench.x_d.p.z() += random.uniform(-1e-3, 1e-3);
    bench.x_d.r = exp_so3({random.uniform(-1e-3, 1e-3), 0.0, 0.0}) * bench.x_d.r;
    if (random.below(2) == 0) bench.x_d.r.coeffs() *= -1.0;
    found_s = swing(bench, {0.0, 0.08, 0.0}, kNone, 4.0, 0.5);
  }
  assert_true(std::isfinite(found_s) && time_s < kSettles_s + 1.0);
}

void without_a_tolerance_nothing_is_refused(void**) {
  PoseBench& bench = fresh();
  bench.law.params.hold_tolerance = 0.0;
  assert_true(std::isinf(swing(bench, {0.2, 0.0, 0.0}, {0.0, 1.0, 0.0}, 2.0, kSettles_s + 1.0)));
}

/// The arm is stopped by others then; it may be moved, and is watched anew when it goes on.
void a_braked_arm_is_not_watched(void**) {
  PoseBench& bench = fresh();
  const Vector3 way(0.2, 0.0, 0.0);
  assert_true(std::isfinite(swing(bench, way, kNone, 2.0, kSettles_s + 1.0)));
  bench.law.brake(Status::kPathTolerance, BrakeWay::kOnPath);
  assert_true(std::isinf(swing(bench, way, kNone, 2.0, kSettles_s + 1.0)));
  ASSERT_OK(bench.law.resume());
  const double found_s = swing(bench, way, kNone, 2.0, kSettles_s + 1.0);
  assert_true(found_s > kSettles_s - 2e-3 && std::isfinite(found_s));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_swing_beyond_the_tolerance_is_found_within_half_a_swing),
      cmocka_unit_test(a_loop_that_swings_by_itself_is_stopped),
      cmocka_unit_test(a_tip_that_circles_is_found),
      cmocka_unit_test(a_reference_that_moves_in_time_is_not_refused),
      cmocka_unit_test(a_tip_that_stands_out_of_reach_or_comes_nearer_is_not_refused),
      cmocka_unit_test(noise_of_a_reference_hides_no_swing),
      cmocka_unit_test(without_a_tolerance_nothing_is_refused),
      cmocka_unit_test(a_braked_arm_is_not_watched),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
