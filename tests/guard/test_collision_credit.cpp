// Tests the credit of the collision check's pairs: on random motions at the limits every check with
// credit says what one says that looks at every pair in all positions.
#include <optional>

#include "tests/guard/collision_bench.hpp"
#include "tests/support/model_cases.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

/// A motion with accelerations at the limits, reversed at random, from a random state of rest.
struct Ride {
  RandomStates states;
  double scale = 1.0;  // of speed and acceleration
  JointVector q, dq, ddq;

  double unit() { return std::uniform_real_distribution<double>(-1.0, 1.0)(states.random); }
  void begin() {
    states.next();
    q = states.q;
    dq.setZero();
    ddq.setZero();
    scale = std::pow(10.0, std::min(0.0, 2.0 * unit()));
  }
  void advance(const JointLimits& limits) {
    constexpr double kDt = CollisionBench::kPeriod_s;
    for (int i = 0; i < kDof; ++i) {
      if (unit() > 0.98) ddq[i] = std::copysign(scale * limits.ddq_max[i], unit());
      const double fastest = scale * limits.dq_max[i];
      if (q[i] > limits.q_max[i] || dq[i] > fastest) ddq[i] = -scale * limits.ddq_max[i];
      if (q[i] < limits.q_min[i] || dq[i] < -fastest) ddq[i] = scale * limits.ddq_max[i];
    }
    q += kDt * dq + 0.5 * kDt * kDt * ddq;
    dq += kDt * ddq;
  }
};

/// Counts what the two say.
struct Verdicts {
  CollisionBench credited, whole;
  std::int64_t cycles = 0, contacts = 0, predicted = 0;

  explicit Verdicts(int check_cycles) {
    for (CollisionBench* bench : {&credited, &whole}) {
      bench->section.cycles = check_cycles;
      bench->start();
    }
  }
  /// Compares check by check, with the state in which each begins, until a contact.
  void run(Ride& ride) {
    ride.begin();
    credited.start();
    for (int i = 0; i < 1500;) {
      const Status expected = whole.check(ride.q, ride.dq);
      const std::int64_t ended = credited.collision.telemetry().checks;
      Status status = Status::kOk;
      while (status == Status::kOk && credited.collision.telemetry().checks == ended) {
        status = credited.step(ride.q, ride.dq);
        ride.advance(credited.limits);
        ++i;
        ++cycles;
      }
      ASSERT_STATUS(status, expected);
      if (status == Status::kOk) continue;
      contacts += 1;
      predicted += credited.collision.telemetry().predicted;
      return;
    }
  }
};

// Proves COL-11.

void with_credit_a_check_says_what_it_says_without(void**) {
  const int rides = trials(tries(600, 60));
  for (const int cycles : {1, 5}) {
    static std::optional<Verdicts> verdicts_;
    Verdicts& verdicts = verdicts_.emplace(cycles);
    Ride ride;
    for (int i = 0; i < rides; ++i) verdicts.run(ride);
    print_message("%d cycles: %lld cycles, %lld contacts, %lld predicted\n", cycles,
                  static_cast<long long>(verdicts.cycles),
                  static_cast<long long>(verdicts.contacts),
                  static_cast<long long>(verdicts.predicted));
    assert_true(verdicts.contacts > rides / 4 && verdicts.predicted > rides / 10);
  }
}

/// The joints turn to and fro for more than 100 rad, where the sums begin anew; then the arm moves
/// on into a contact.
void credit_that_was_used_up_is_renewed_in_time(void**) {
  static CollisionBench credited, whole;
  credited.section.cycles = whole.section.cycles = 1;
  whole.start();
  RandomStates states;
  const auto next_that = [&states](Status wanted) {
    do states.next();
    while (whole.check(states.q, JointVector::Zero()) != wanted);
    return states.q;
  };
  int contacts = 0;
  for (int i = 0; i < tries(20, 4); ++i) {
    const JointVector q = next_that(Status::kOk), way = next_that(Status::kCollision) - q;
    credited.start();
    Status status = Status::kOk;
    for (int k = 0; k <= 3200 && status == Status::kOk; ++k) {
      const JointVector at = q + (k < 1200 ? 0.05 * (k % 2) : (k - 1200) / 2000.0) * way;
      status = credited.step(at, JointVector::Zero());
      ASSERT_STATUS(status, whole.check(at, JointVector::Zero()));
    }
    contacts += status == Status::kCollision;
  }
  assert_int_equal(contacts, tries(20, 4));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(with_credit_a_check_says_what_it_says_without),
      cmocka_unit_test(credit_that_was_used_up_is_renewed_in_time),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
