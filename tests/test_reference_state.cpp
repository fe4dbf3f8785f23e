// The two-state machine of the reference generators, against the paper's sentences: a trajectory
// that is received switches to its execution; when it is completed, aborted, or a new reference is
// received, the generator returns to online references.   [Risi et al. 2026, section II]
#include "kernel/reference/reference_state.hpp"

#include "tests/testing.hpp"

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

void the_table_has_one_row_for_every_state_and_event_and_next_reads_that_row(void**) {
  assert_int_equal(kReferenceTransitions.size(), 2 * 4);
  for (const ReferenceTransition& row : kReferenceTransitions) {
    int rows = 0;
    for (const ReferenceTransition& other : kReferenceTransitions)
      rows += other.from == row.from && other.event == row.event;
    assert_int_equal(rows, 1);
    assert_true(next(row.from, row.event) == row.to);
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
      cmocka_unit_test(the_table_has_one_row_for_every_state_and_event_and_next_reads_that_row),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
