// Tests tares of the wrench front end while it runs: the sensor has drifted, and a law goes on with
// its wrench.
#include "tests/control/admittance_bench.hpp"
#include "tests/control/wrench_bench.hpp"

namespace tactus {
namespace {

constexpr int kTrials = 100;
constexpr double kForceNoise = 0.5, kMomentNoise = 0.05;  // of every axis, below the tolerances

/// A number from `lowest` to `highest`.
double between(RandomVectors& random, double lowest, double highest) {
  return lowest + 0.5 * (1.0 + random.unit()) * (highest - lowest);
}
/// A wrench whose force and moment have these lengths.
Vector6 of_lengths(RandomVectors& random, double force, double moment) {
  return wrench(force * random.vector().normalized(), moment * random.vector().normalized());
}
Vector6 noise(RandomVectors& random) {
  Vector6 v;
  for (int i = 0; i < 6; ++i) v[i] = (i < 3 ? kForceNoise : kMomentNoise) * random.unit();
  return v;
}

/// A bench that has tared at start, in another pose for every seed.
struct Tared : WrenchBench {
  explicit Tared(int trial) {
    random.bits.seed(kSeed + static_cast<unsigned>(trial));
    front.params.max_tare_force = 10.0;
    front.params.max_tare_moment = 1.0;
    tare();
    turn();
    feel(kNone);
  }
  /// Steps with noise until the tare has its result. Returns the number of steps.
  int await(const Vector6& h) {
    int steps = 0;
    for (; front.tares() && steps < 2000; ++steps) {
      feel(h);
      ft += noise(random);
      ASSERT_OK(front.step(kPeriod_s));
    }
    assert_false(front.tares());
    return steps;
  }
  /// What moves the bias by `change`, at the tip.
  double most_at_tip(double force, double moment) const {
    return force + moment + tool.tip.p.norm() * force;
  }
};

// Proves WF-5.

/// Seeded drifts within the limits: the new bias is the mean over the interval, so it is wrong by
/// the noise at most.
void after_a_tare_a_drifted_sensor_feels_nothing(void**) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Tared b(trial);
    const double force = between(b.random, 0.0, 9.0), moment = between(b.random, 0.0, 0.9);
    b.bias += of_lengths(b.random, force, moment);
    ASSERT_OK(b.front.begin_tare());
    assert_int_equal(b.await(kNone), 100);
    ASSERT_OK(b.front.tared().status);
    assert_true((b.front.bias.value - b.bias).head<3>().cwiseAbs().maxCoeff() <= kForceNoise);
    assert_true((b.front.bias.value - b.bias).tail<3>().cwiseAbs().maxCoeff() <= kMomentNoise);
    b.feel(kNone);
    ASSERT_OK(b.run(501));
    const double most = std::sqrt(3.0) * b.most_at_tip(kForceNoise, kMomentNoise);
    assert_true(b.front.h.value.head<3>().norm() <= std::sqrt(3.0) * kForceNoise);
    assert_true(b.front.h.value.tail<3>().norm() <= most);
  }
}

/// Beside a twin that is not tared, on the same readings: until the tare is done they are the same
/// to the last bit; then what parts them grows by what the fade allows in a period, to all of it.
void h_goes_on_without_a_step(void**) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Tared b(trial);
    b.front.params.time_constant_s = trial % 2 == 0 ? 0.0 : 0.02;
    WrenchFrontEnd twin = b.front;
    const Vector6 drift = of_lengths(b.random, 9.0, 0.9), h = b.random.unit() * drift;
    b.bias += drift;
    for (WrenchFrontEnd* front : {&b.front, &twin}) assert_true(front->ft.source == &b.ft);
    ASSERT_OK(b.front.begin_tare());
    Vector6 apart = kNone;
    const double most = 1.5 * kPeriod_s / kTransfer_s * b.most_at_tip(20.0, 2.0);
    for (int k = 0; k < 1000; ++k) {
      b.feel(k < 300 ? kNone : Vector6(0.1 * h));
      b.ft += noise(b.random);
      const bool tares = b.front.tares();
      ASSERT_OK(b.front.step(kPeriod_s));
      ASSERT_OK(twin.step(kPeriod_s));
      const Vector6 now = twin.h.value - b.front.h.value;
      if (tares) assert_true(now == kNone);
      assert_true((now - apart).norm() <= most);
      apart = now;
    }
    ASSERT_OK(b.front.tared().status);
    assert_true(apart.head<3>().norm() >= 9.0 - std::sqrt(3.0) * kForceNoise);
  }
}

/// With a dead band, and with a change of parameters that has not faded yet.
void h_goes_on_with_a_dead_band_that_has_just_changed(void**) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Tared b(trial);
    b.bias += of_lengths(b.random, 9.0, 0.9);
    b.feel(kNone);
    ASSERT_OK(b.front.begin_tare());
    ASSERT_OK(b.run(static_cast<int>(between(b.random, 1.0, 99.0))));
    WrenchFrontEnd::Params next = b.front.params;
    next.dead_force = between(b.random, 0.0, 12.0);
    b.front.retune(next, JointLimits());
    const double most = 1.5 * kPeriod_s / kTransfer_s * b.most_at_tip(9.0, 0.9);
    for (Vector6 before = b.front.h.value; b.front.tares() || b.front.h.value != kNone;) {
      ASSERT_OK(b.front.step(kPeriod_s));
      assert_true((b.front.h.value - before).norm() <= 2.0 * most);
      before = b.front.h.value;
      if (!b.front.tares() && before.norm() < 1e-9) break;
    }
    ASSERT_OK(b.front.tared().status);
  }
}

/// 4 N over 100 N/m are 40 mm. A step of 4 N would change the velocity of 1 kg by 4 mm/s in a
/// period; the fade, of 12 N/s at most against 40 N s/m, by 0.3 mm/s.
void an_admittance_that_a_drift_has_moved_goes_back_softly(void**) {
  for (int trial = 0; trial < 20; ++trial) {
    Tared b(trial);
    AdmittanceBench law;
    ASSERT_OK(law.ac.start());
    const auto run = [&](int cycles) {
      double most = 0.0;
      for (int i = 0; i < cycles; ++i) {
        const Vector6 v = law.ac.v_c.value;
        ASSERT_OK(b.front.step(kPeriod_s));
        law.h = b.front.h.value;
        ASSERT_OK(law.ac.step(kPeriod_s));
        most = std::max(most, (law.ac.v_c.value - v).head<3>().norm());
      }
      return most;
    };
    b.bias += of_lengths(b.random, 4.0, 0.0);
    b.feel(kNone);
    run(10000);
    ASSERT_NEAR(law.moved().norm(), 0.04, 1e-6);
    ASSERT_OK(b.front.begin_tare());
    const double while_taring = run(100), after = run(10000);
    ASSERT_OK(b.front.tared().status);
    assert_true(while_taring <= 1e-9 && after <= 0.3e-3);
    ASSERT_NEAR(law.moved().norm(), 0.0, 1e-6);
  }
}

void a_bump_begins_the_interval_anew_and_nothing_else(void**) {
  Tared b(0);
  b.bias[0] += 4.0;
  b.feel(kNone);
  ASSERT_OK(b.front.begin_tare());
  ASSERT_OK(b.run(80));
  b.ft[2] += 2.1;
  ASSERT_OK(b.run(1));
  b.feel(kNone);
  ASSERT_OK(b.run(99));
  assert_true(b.front.tares());
  ASSERT_OK(b.run(1));
  assert_false(b.front.tares());
  assert_same(b.front.bias.value, b.bias, 1e-12);
}

void the_flag_of_the_tare_at_start_is_not_set(void**) {
  Tared b(0);
  ASSERT_OK(b.front.begin_tare());
  for (int i = 0; i < 100; ++i) {
    assert_false(b.front.taring.value);
    ASSERT_OK(b.run(1));
  }
}

// Proves WF-6.

/// Seeded contacts beyond a limit, drift included: refused with the figures, and still felt.
void a_contact_beyond_the_limits_is_never_made_zero(void**) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Tared b(trial);
    const bool by_force = trial % 2 == 0;
    const double force = by_force ? between(b.random, 11.0, 100.0) : 0.0;
    const double moment = by_force ? 0.0 : between(b.random, 1.2, 9.0);
    const Vector6 contact = of_lengths(b.random, force, moment);
    const Vector6 before = b.front.bias.value;
    for (int again = 0; again < 3; ++again) {
      ASSERT_OK(b.front.begin_tare());
      b.await(contact);
      const Verdict verdict = b.front.tared();
      ASSERT_STATUS(verdict.status, Status::kTareLimit);
      if (by_force) assert_int_equal(verdict.axis, 0);
      if (verdict.axis == 0) ASSERT_NEAR(verdict.value, force, std::sqrt(3.0) * kForceNoise);
      if (verdict.axis == 3) ASSERT_NEAR(verdict.value, moment, std::sqrt(3.0) * kMomentNoise);
      assert_true(verdict.limit == (verdict.axis == 0 ? 10.0 : 1.0));
      assert_true(b.front.bias.value == before);
    }
    b.feel(contact);
    ASSERT_OK(b.run(1));
    assert_same(b.front.h.value, contact, 1e-9);
  }
}

/// A law that yields presses on by what a tare has taken: tare after tare in contact.
void tares_that_are_repeated_in_contact_take_no_more_than_one_may(void**) {
  for (int trial = 0; trial < kTrials; ++trial) {
    Tared b(trial);
    b.front.params.max_tare_moment = 100.0;  // the force has a lever at the flange
    const Vector6 at_start = b.front.bias.value;
    const Vector6 push = of_lengths(b.random, between(b.random, 3.0, 9.0), 0.0);
    int taken = 0, refused = 0;
    for (int again = 0; again < 12; ++again) {
      ASSERT_OK(b.front.begin_tare());
      b.await((again + 1) * push);
      ++(b.front.tared().ok() ? taken : refused);
      assert_true((b.front.bias.value - at_start).head<3>().norm() <= 10.0);
    }
    assert_true(taken >= 1 && taken <= 3 && refused >= 9);
  }
}

/// The pipeline goes on, with the old bias.
void a_signal_that_does_not_rest_is_refused_and_stops_nothing(void**) {
  Tared b(0);
  const Vector6 before = b.front.bias.value;
  ASSERT_OK(b.front.begin_tare());
  for (int i = 1; i <= 1000; ++i) {
    assert_true(b.front.tares());
    b.feel(wrench({0.0, 5.0 * std::sin(0.03 * i), 0.0}, Vector3::Zero()));
    ASSERT_OK(b.front.step(kPeriod_s));
    ASSERT_NEAR(b.front.h.value[1], 5.0 * std::sin(0.03 * i), 1e-9);
  }
  assert_false(b.front.tares());
  ASSERT_STATUS(b.front.tared().status, Status::kSensorNotSteady);
  assert_true(b.front.bias.value == before);
  ASSERT_OK(b.run(2000));
}

void without_a_tare_at_start_there_is_none_later(void**) {
  WrenchBench b;
  b.front.params.tare_s = 0.0;
  ASSERT_OK(b.front.start());
  ASSERT_OK(b.run(1));
  ASSERT_STATUS(b.front.begin_tare(), Status::kNotOffered);
  assert_false(b.front.tares());
}

void one_tare_is_under_way_at_a_time(void**) {
  WrenchBench b;
  ASSERT_OK(b.front.start());
  ASSERT_OK(b.run(1));
  ASSERT_STATUS(b.front.begin_tare(), Status::kMailboxFull);  // that of the start
  assert_false(b.front.tares());
  ASSERT_OK(b.run(99));
  ASSERT_OK(b.front.begin_tare());
  ASSERT_OK(b.run(60));
  ASSERT_STATUS(b.front.begin_tare(), Status::kMailboxFull);
  ASSERT_OK(b.run(40));  // the second has not begun it anew
  assert_false(b.front.tares());
}

/// Any order of begins, steps, brakes and starts: each begin that was taken ends once, within its
/// time-out, and one that a brake or start ends changes no bias.
void whatever_comes_every_tare_ends_once(void**) {
  RandomVectors random;
  Tared b(0);
  int begun = 0, ended = 0, broken = 0;
  for (int k = 0; k < 200000; ++k) {
    const bool tares = b.front.tares();
    const Vector6 before = b.front.bias.value;
    const double chance = between(random, 0.0, 1.0);
    if (chance < 0.01) {
      const Status status = b.front.begin_tare();
      if (status == Status::kOk) ++begun;
      assert_true(status == Status::kOk ? !tares && b.front.tares()
                                        : tares || b.front.taring.value);
    } else if (chance < 0.012) {
      b.front.brake(Status::kHalted, BrakeWay::kOnPath);
      if (tares) ASSERT_STATUS(b.front.tared().status, Status::kHalted);
      assert_true(b.front.bias.value == before);
    } else if (chance < 0.013) {
      ASSERT_OK(b.front.start());
      if (tares) ASSERT_STATUS(b.front.tared().status, Status::kNotStarted);
      assert_true(b.front.taring.value);
    }
    broken += tares && !b.front.tares();
    ended += tares && !b.front.tares();
    const bool runs = b.front.tares();
    b.feel(kNone);
    b.ft += noise(random);
    ASSERT_OK(b.front.step(kPeriod_s));
    ended += runs && !b.front.tares();
  }
  assert_int_equal(begun, ended + b.front.tares());
  assert_true(begun > 500 && broken > 50 && ended > broken + 50);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(after_a_tare_a_drifted_sensor_feels_nothing),
      cmocka_unit_test(h_goes_on_without_a_step),
      cmocka_unit_test(h_goes_on_with_a_dead_band_that_has_just_changed),
      cmocka_unit_test(an_admittance_that_a_drift_has_moved_goes_back_softly),
      cmocka_unit_test(a_bump_begins_the_interval_anew_and_nothing_else),
      cmocka_unit_test(the_flag_of_the_tare_at_start_is_not_set),
      cmocka_unit_test(a_contact_beyond_the_limits_is_never_made_zero),
      cmocka_unit_test(tares_that_are_repeated_in_contact_take_no_more_than_one_may),
      cmocka_unit_test(a_signal_that_does_not_rest_is_refused_and_stops_nothing),
      cmocka_unit_test(without_a_tare_at_start_there_is_none_later),
      cmocka_unit_test(one_tare_is_under_way_at_a_time),
      cmocka_unit_test(whatever_comes_every_tare_ends_once),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
