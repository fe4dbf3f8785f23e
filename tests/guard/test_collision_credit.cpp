// Tests the credit of the collision check's pairs: on random motions at the limits every check with
// credit says what a check by this file says, which looks at every pair in all positions. The arm
// is at its reference, or behind it.
#include <optional>

#include "tests/guard/arm_capsules.hpp"
#include "tests/guard/collision_bench.hpp"
#include "tests/guard/ride.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

/// In which a check begins: the arm, and what it follows.
struct Begin {
  JointVector q, dq, q_d, dq_d;
};

/// A check without credit, of a bench's scene.
struct EveryPair {
  const CollisionBench& bench;
  std::array<ArmCapsule, kArmCapsules> capsules;
  Braking braking;

  EveryPair(const CollisionBench& of, bool has_reference) : bench(of) {
    for (std::size_t i = 0; i < RobotCapsules::kCapsules.size(); ++i)
      capsules[i] = ArmCapsule(RobotCapsules::kCapsules[i]);
    capsules.back() = {kDof,
                       {dense(from_flange<Robot>(Vector3::Zero())),
                        dense(from_flange<Robot>(bench.tip)), bench.section.tool_radius}};
    braking.acceleration = bench.limits.ddq_max;
    braking.deceleration = bench.section.braking;
    braking.reaction_s = 2 * bench.section.cycles * CollisionBench::kPeriod_s +
                         (braking.acceleration + braking.deceleration)
                             .cwiseQuotient(bench.limits.dddq_max)
                             .maxCoeff();
    if (!has_reference) braking.reaction_s += bench.section.lateness.maxCoeff();
  }
  Status check(const Begin& begin) const {
    const JointVector lag = begin.q_d - begin.q;
    JointVector error;
    for (int i = 0; i < kDof; ++i)
      error[i] =
          bench.section.lateness[i] * std::abs(begin.dq[i]) +
          bench.section.overshoot[i] * (std::abs(lag[i]) + stopping_range(braking, begin.dq_d)[i]);
    bool apart = are_apart(begin.q, JointVector::Zero());
    for (int section = 0; section < kSections && apart; ++section) {
      const JointBox box = stopping_box(braking, begin.q + 0.5 * lag, begin.dq_d, section);
      apart = are_apart(box.middle, box.half + 0.5 * lag.cwiseAbs() + error);
    }
    return apart ? Status::kOk : Status::kCollision;
  }
  Status check(const JointVector& q) const {
    return check({q, JointVector::Zero(), q, JointVector::Zero()});
  }

 private:
  bool are_apart(const JointVector& q, const JointVector& half) const {
    const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(q));
    std::array<Capsule, kArmCapsules> placed;
    for (std::size_t i = 0; i < placed.size(); ++i) placed[i] = capsules[i].placed(frames);
    for (std::size_t second = 0; second < placed.size(); ++second) {
      const auto needs = [&](int axis) {
        return bench.section.margin + capsules[second].way(axis, half);
      };
      for (std::size_t first = 0; first < second; ++first)
        if (can_meet(static_cast<int>(first), static_cast<int>(second)) &&
            !(separation(placed[second], placed[first]) > needs(capsules[first].link)))
          return false;
      for (const Cuboid& box : bench.boxes)
        if (capsules[second].link > 0 &&
            !(separation(placed[second],
                         {box.pose.r.toRotationMatrix(), box.pose.p, 0.5 * box.size}) > needs(0)))
          return false;
    }
    return true;
  }
};

/// Counts what the two say.
struct Verdicts {
  CollisionBench credited;
  std::int64_t cycles = 0, contacts = 0, predicted = 0;

  Begin now;  // in this cycle
  bool behind;

  /// An arm `behind` has a reference; one that is `late` has not.
  Verdicts(int check_cycles, bool behind_reference, bool late) : behind(behind_reference) {
    credited.section.cycles = check_cycles;
    for (int i = 0; i < kDof && (behind || late); ++i) {
      credited.section.lateness[i] = 0.01 * i;
      credited.section.overshoot[i] = 0.05 * (kDof - 1 - i);
    }
  }
  void begin(Ride& ride) {
    ride.begin();
    now = {ride.q, ride.dq, ride.q, behind ? JointVector(JointVector::Zero()) : ride.dq};
    credited.start(behind ? &now.q_d : nullptr);
  }
  /// Moves the reference with the ride, and the arm with it or behind.
  void advance(Ride& ride) {
    constexpr double kLag_s = 0.03;
    ride.advance(credited.limits);
    now.dq_d = (ride.q - now.q_d) / CollisionBench::kPeriod_s;
    now.q_d = ride.q;
    now.dq = (now.q_d - now.q) / kLag_s;
    now.q += CollisionBench::kPeriod_s * now.dq;
    if (!behind) now = {ride.q, ride.dq, ride.q, ride.dq};
  }
  /// Compares check by check, with the state in which each begins, until a contact.
  void run(Ride& ride) {
    const EveryPair whole(credited, behind);
    begin(ride);
    for (int i = 0; i < 1500;) {
      const Status expected = whole.check(now);
      const std::int64_t ended = credited.collision.telemetry().checks;
      Status status = Status::kOk;
      while (status == Status::kOk && credited.collision.telemetry().checks == ended) {
        status = credited.step(now.q, now.dq);
        advance(ride);
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
  const int rides = trials(tries(100, 15));
  constexpr struct {
    int cycles;
    bool behind, late;
  } kKinds[] = {
      {1, false, false}, {5, false, false}, {1, true, false}, {5, true, false}, {2, false, true}};
  for (const auto& [cycles, behind, late] : kKinds) {
    static std::optional<Verdicts> verdicts_;
    Verdicts& verdicts = verdicts_.emplace(cycles, behind, late);
    Ride ride;
    for (int i = 0; i < rides; ++i) verdicts.run(ride);
    print_message("%d cycles%s: %lld cycles, %lld contacts, %lld predicted\n", cycles,
                  behind ? ", behind"
                  : late ? ", late"
                         : "",
                  static_cast<long long>(verdicts.cycles),
                  static_cast<long long>(verdicts.contacts),
                  static_cast<long long>(verdicts.predicted));
    assert_true(verdicts.contacts > rides / 4 && verdicts.predicted > rides / 10);
  }
}

/// The joints turn to and fro for more than 100 rad, where the sums begin anew; then the arm moves
/// on into a contact.
void credit_that_was_used_up_is_renewed_in_time(void**) {
  static CollisionBench credited;
  credited.section.cycles = 1;
  const EveryPair whole(credited, false);
  RandomStates states;
  const auto next_that = [&](Status wanted) {
    do states.next();
    while (whole.check(states.q) != wanted);
    return states.q;
  };
  int contacts = 0;
  for (int i = 0; i < tries(6, 3); ++i) {
    const JointVector q = next_that(Status::kOk), way = next_that(Status::kCollision) - q;
    credited.start();
    Status status = Status::kOk;
    for (int k = 0; k <= 3200 && status == Status::kOk; ++k) {
      const JointVector at = q + (k < 1200 ? 0.05 * (k % 2) : (k - 1200) / 2000.0) * way;
      status = credited.step(at, JointVector::Zero());
      ASSERT_STATUS(status, whole.check(at));
    }
    contacts += status == Status::kCollision;
  }
  assert_int_equal(contacts, tries(6, 3));
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
