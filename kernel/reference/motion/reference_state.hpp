// The two states of a reference generator and its transitions, as in the paper's figure.
#pragma once

#include <cstdint>

namespace tactus {

enum class ReferenceState : std::uint8_t { kOnlineReference, kTrajectoryExecution };

enum class ReferenceEvent : std::uint8_t {
  kTrajectoryAccepted,
  kTrajectoryCompleted,
  kTrajectoryCanceled,
  kNewReference,
};

/// Returns the state after `event`, the same from both states: an accepted trajectory is executed,
/// and everything else ends the one that is. [any]
constexpr ReferenceState next(ReferenceState /*state*/, ReferenceEvent event) {
  return event == ReferenceEvent::kTrajectoryAccepted ? ReferenceState::kTrajectoryExecution
                                                      : ReferenceState::kOnlineReference;
}

}  // namespace tactus
