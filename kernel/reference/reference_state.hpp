// The two states of a reference generator, as in the paper's figure of the finite state machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus {

enum class ReferenceState : std::uint8_t { kOnlineReference, kTrajectoryExecution };

enum class ReferenceEvent : std::uint8_t {
  kTrajectoryAccepted,
  kTrajectoryCompleted,
  kTrajectoryCanceled,
  kNewReference,
};

struct ReferenceTransition {
  ReferenceState from;
  ReferenceEvent event;
  ReferenceState to;
};

inline constexpr std::size_t kReferenceStates = 2, kReferenceEvents = 4;

// clang-format off
inline constexpr std::array<ReferenceTransition, kReferenceStates * kReferenceEvents> kReferenceTransitions = {{
    {ReferenceState::kOnlineReference,     ReferenceEvent::kTrajectoryAccepted,  ReferenceState::kTrajectoryExecution},
    {ReferenceState::kOnlineReference,     ReferenceEvent::kTrajectoryCompleted, ReferenceState::kOnlineReference},
    {ReferenceState::kOnlineReference,     ReferenceEvent::kTrajectoryCanceled,  ReferenceState::kOnlineReference},
    {ReferenceState::kOnlineReference,     ReferenceEvent::kNewReference,        ReferenceState::kOnlineReference},
    {ReferenceState::kTrajectoryExecution, ReferenceEvent::kTrajectoryAccepted,  ReferenceState::kTrajectoryExecution},
    {ReferenceState::kTrajectoryExecution, ReferenceEvent::kTrajectoryCompleted, ReferenceState::kOnlineReference},
    {ReferenceState::kTrajectoryExecution, ReferenceEvent::kTrajectoryCanceled,  ReferenceState::kOnlineReference},
    {ReferenceState::kTrajectoryExecution, ReferenceEvent::kNewReference,        ReferenceState::kOnlineReference},
}};
// clang-format on

/// The state after `event`. The table holds every pair, in order. [any]
constexpr ReferenceState next(ReferenceState state, ReferenceEvent event) {
  const std::size_t row =
      static_cast<std::size_t>(state) * kReferenceEvents + static_cast<std::size_t>(event);
  return kReferenceTransitions[row].to;
}

namespace detail {
constexpr bool table_is_in_order() {
  for (std::size_t row = 0; row < kReferenceTransitions.size(); ++row) {
    if (static_cast<std::size_t>(kReferenceTransitions[row].from) != row / kReferenceEvents ||
        static_cast<std::size_t>(kReferenceTransitions[row].event) != row % kReferenceEvents)
      return false;
  }
  return true;
}
}  // namespace detail
static_assert(detail::table_is_in_order());

}  // namespace tactus
