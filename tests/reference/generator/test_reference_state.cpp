// The two-state machine of the reference generators against the paper's sentences: a trajectory
// that is received switches to its execution; when it is completed, aborted, or a new reference is
// received, the generator returns to online references.   [Risi et al. 2026, section II]
// The phases that make up the two states: all can be reached, and there is always a way to rest and
// to a new trajectory.
#include "kernel/reference/motion/motion_phase.hpp"

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr ReferenceState kStates[] = {ReferenceState::kOnlineReference,
                                      ReferenceState::kTrajectoryExecution};

// Proves RG-1.

void whatever_the_state_an_accepted_trajectory_is_executed(void**) {
  for (const ReferenceState from : kStates)
    assert_true(next(from, ReferenceEvent::kTrajectoryAccepted) ==
                ReferenceState::kTrajectoryExecution);
}

void a_trajectory_that_is_completed_leads_to_online_references(void**) {
  assert_true(next(ReferenceState::kTrajectoryExecution, ReferenceEvent::kTrajectoryCompleted) ==
              ReferenceState::kOnlineReference);
}

void a_trajectory_that_is_canceled_leads_to_online_references(void**) {
  assert_true(next(ReferenceState::kTrajectoryExecution, ReferenceEvent::kTrajectoryCanceled) ==
              ReferenceState::kOnlineReference);
}

void a_new_reference_ends_a_trajectory(void**) {
  assert_true(next(ReferenceState::kTrajectoryExecution, ReferenceEvent::kNewReference) ==
              ReferenceState::kOnlineReference);
}

void online_nothing_but_a_trajectory_changes_the_state(void**) {
  for (const ReferenceEvent event :
       {ReferenceEvent::kTrajectoryCompleted, ReferenceEvent::kTrajectoryCanceled,
        ReferenceEvent::kNewReference})
    assert_true(next(ReferenceState::kOnlineReference, event) == ReferenceState::kOnlineReference);
}

constexpr MotionPhase phase(std::size_t i) {
  return static_cast<MotionPhase>(i);
}
constexpr MotionEvent event(std::size_t i) {
  return static_cast<MotionEvent>(i);
}

// Proves RG-1, RG-3.

void every_phase_can_be_reached_from_holding(void**) {
  std::array<bool, kPhases> reached{};
  reached[static_cast<std::size_t>(MotionPhase::kHolding)] = true;
  for (std::size_t round = 0; round < kPhases; ++round) {
    for (std::size_t from = 0; from < kPhases; ++from) {
      for (std::size_t e = 0; reached[from] && e < kMotionEvents; ++e)
        reached[static_cast<std::size_t>(next(phase(from), event(e)))] = true;
    }
  }
  for (const bool is : reached) assert_true(is);
}

bool is_reference(MotionEvent event) {
  return event == MotionEvent::kPoint || event == MotionEvent::kTrajectory ||
         event == MotionEvent::kChunk || event == MotionEvent::kVelocity;
}

/// Without a new reference, a stop stays a stop or is at rest, and rest ends it.
void a_stop_leads_to_holding_from_everywhere_and_nothing_but_a_new_reference_keeps_it(void**) {
  for (std::size_t from = 0; from < kPhases; ++from) {
    const MotionPhase stopped = next(phase(from), MotionEvent::kStop);
    assert_true(stopped == MotionPhase::kStopping || stopped == MotionPhase::kHolding);
    assert_true(next(stopped, MotionEvent::kAtRest) == MotionPhase::kHolding);
  }
  for (const MotionPhase resting : {MotionPhase::kStopping, MotionPhase::kHolding}) {
    for (std::size_t e = 0; e < kMotionEvents; ++e) {
      if (is_reference(event(e))) continue;
      const MotionPhase then = next(resting, event(e));
      assert_true(then == resting || then == MotionPhase::kHolding);
    }
  }
}

/// A cancelled trajectory ends where its path has come to rest, or off the path.
void a_cancel_leads_to_rest_and_ends_every_trajectory(void**) {
  for (std::size_t from = 0; from < kPhases; ++from) {
    MotionPhase then = next(phase(from), MotionEvent::kCancel);
    assert_true(state_of(then) == ReferenceState::kOnlineReference);
    assert_int_equal(on_path(then), on_path(phase(from)));
    if (on_path(then)) then = next(then, MotionEvent::kEnd);
    assert_true(!on_path(then) && next(then, MotionEvent::kAtRest) == MotionPhase::kHolding);
  }
}

void an_accepted_trajectory_is_joined_and_a_point_is_reached_from_everywhere(void**) {
  for (std::size_t from = 0; from < kPhases; ++from) {
    assert_true(next(phase(from), MotionEvent::kTrajectory) == MotionPhase::kJoining);
    assert_true(next(phase(from), MotionEvent::kPoint) == MotionPhase::kReaching);
    assert_true(next(phase(from), MotionEvent::kChunk) == MotionPhase::kTracking);
    assert_true(next(phase(from), MotionEvent::kVelocity) == MotionPhase::kDriving);
  }
}

/// From every phase of a trajectory its end can be reached by events of its path and a resume.
void a_trajectory_that_is_fed_and_resumed_can_always_complete(void**) {
  for (std::size_t from = 0; from < kPhases; ++from) {
    if (state_of(phase(from)) != ReferenceState::kTrajectoryExecution) continue;
    MotionPhase then = next(next(phase(from), MotionEvent::kResume), MotionEvent::kFed);
    assert_true(then == MotionPhase::kJoining || then == MotionPhase::kFollowing ||
                then == MotionPhase::kSettling);
    then = next(next(then, MotionEvent::kJoined), MotionEvent::kEnd);
    assert_true(then == MotionPhase::kSettling);
    assert_true(state_of(next(then, MotionEvent::kComplete)) == ReferenceState::kOnlineReference);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(whatever_the_state_an_accepted_trajectory_is_executed),
      cmocka_unit_test(a_trajectory_that_is_completed_leads_to_online_references),
      cmocka_unit_test(a_trajectory_that_is_canceled_leads_to_online_references),
      cmocka_unit_test(a_new_reference_ends_a_trajectory),
      cmocka_unit_test(online_nothing_but_a_trajectory_changes_the_state),
      cmocka_unit_test(every_phase_can_be_reached_from_holding),
      cmocka_unit_test(
          a_stop_leads_to_holding_from_everywhere_and_nothing_but_a_new_reference_keeps_it),
      cmocka_unit_test(a_cancel_leads_to_rest_and_ends_every_trajectory),
      cmocka_unit_test(an_accepted_trajectory_is_joined_and_a_point_is_reached_from_everywhere),
      cmocka_unit_test(a_trajectory_that_is_fed_and_resumed_can_always_complete),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
