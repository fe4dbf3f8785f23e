// The phases of a reference's motion, which make up the two states of the paper's figure, and the
// events that lead from one to another.
//
//   online       holding    at rest until the next request
//                reaching   on the way to a point, or along with a stream of points
//                stopping   on the fastest way to rest, wherever that ends
//                braking    on the path of a trajectory that was given up, until it is at rest
//                leaving    the same, to go to a point once a stop stays inside limits
//   trajectory   joining    the path runs; the reference is on its way to it
//                following  on the path
//                paused     the path comes to rest and waits
//                starving   an open path has run out of waypoints and waits
//                settling   the path has ended; the robot has yet to arrive
#pragma once

#include <array>
#include <cstddef>

#include "kernel/core/names.hpp"
#include "kernel/reference/motion/reference_state.hpp"

namespace tactus {

enum class Phase : std::uint8_t {
  kHolding,
  kReaching,
  kStopping,
  kBraking,
  kLeaving,
  kJoining,
  kFollowing,
  kPaused,
  kStarving,
  kSettling,
};

enum class MotionEvent : std::uint8_t {
  kPoint,       ///< a point to go to, or to forward as it is
  kLeave,       ///< a point to go to once the path can be left
  kStop,        ///< come to rest at once
  kTrajectory,  ///< a trajectory was accepted
  kCancel,      ///< come to rest on the path, if there is one
  kComplete,    ///< the robot has arrived
  kJoined,      ///< the reference is on its path
  kPause,
  kResume,
  kDry,     ///< an open path is at rest at its present end
  kFed,     ///< an open path moves again
  kEnd,     ///< the path has ended, or has come to rest after it was given up
  kAtRest,  ///< the reference has come to rest
};

constexpr const char* name(Phase phase) {
  switch (phase) {
    case Phase::kHolding: return "holding";
    case Phase::kReaching: return "reaching";
    case Phase::kStopping: return "stopping";
    case Phase::kBraking: return "braking";
    case Phase::kLeaving: return "leaving";
    case Phase::kJoining: return "joining";
    case Phase::kFollowing: return "following";
    case Phase::kPaused: return "paused";
    case Phase::kStarving: return "starving";
    case Phase::kSettling: return "settling";
  }
  return nullptr;
}

inline constexpr std::size_t kPhases = kNames<Phase>.size();
inline constexpr std::size_t kMotionEvents = static_cast<std::size_t>(MotionEvent::kAtRest) + 1;

namespace detail {
using P = Phase;
// clang-format off
inline constexpr std::array<std::array<Phase, kMotionEvents>, kPhases> kPhaseTable = {{
    //           kPoint         kLeave       kStop         kTrajectory  kCancel       kComplete     kJoined        kPause        kResume       kDry          kFed          kEnd          kAtRest
    /*holding*/  {P::kReaching,  P::kHolding, P::kHolding,  P::kJoining, P::kHolding,  P::kHolding,  P::kHolding,   P::kHolding,  P::kHolding,  P::kHolding,  P::kHolding,  P::kHolding,  P::kHolding},
    /*reaching*/ {P::kReaching,  P::kReaching,P::kStopping, P::kJoining, P::kStopping, P::kReaching, P::kReaching,  P::kReaching, P::kReaching, P::kReaching, P::kReaching, P::kReaching, P::kHolding},
    /*stopping*/ {P::kReaching,  P::kStopping,P::kStopping, P::kJoining, P::kStopping, P::kStopping, P::kStopping,  P::kStopping, P::kStopping, P::kStopping, P::kStopping, P::kStopping, P::kHolding},
    /*braking*/  {P::kReaching,  P::kLeaving, P::kStopping, P::kJoining, P::kBraking,  P::kBraking,  P::kBraking,   P::kBraking,  P::kBraking,  P::kBraking,  P::kBraking,  P::kReaching, P::kBraking},
    /*leaving*/  {P::kReaching,  P::kLeaving, P::kStopping, P::kJoining, P::kBraking,  P::kLeaving,  P::kLeaving,   P::kLeaving,  P::kLeaving,  P::kLeaving,  P::kLeaving,  P::kReaching, P::kLeaving},
    /*joining*/  {P::kReaching,  P::kLeaving, P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kFollowing, P::kPaused,   P::kJoining,  P::kStarving, P::kJoining,  P::kSettling, P::kJoining},
    /*following*/{P::kReaching,  P::kLeaving, P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kFollowing, P::kPaused,   P::kFollowing,P::kStarving, P::kFollowing,P::kSettling, P::kFollowing},
    /*paused*/   {P::kReaching,  P::kLeaving, P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kPaused,    P::kPaused,   P::kJoining,  P::kPaused,   P::kPaused,   P::kSettling, P::kPaused},
    /*starving*/ {P::kReaching,  P::kLeaving, P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kStarving,  P::kPaused,   P::kStarving, P::kStarving, P::kJoining,  P::kSettling, P::kStarving},
    /*settling*/ {P::kReaching,  P::kReaching,P::kStopping, P::kJoining, P::kReaching, P::kReaching, P::kSettling,  P::kSettling, P::kSettling, P::kSettling, P::kSettling, P::kSettling, P::kSettling},
}};
// clang-format on
}  // namespace detail

/// Returns the phase after `event`. [any]
constexpr Phase next(Phase phase, MotionEvent event) {
  return detail::kPhaseTable[static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
}

/// Returns the paper's state that a phase belongs to. [any]
constexpr ReferenceState state_of(Phase phase) {
  return phase >= Phase::kJoining ? ReferenceState::kTrajectoryExecution
                                  : ReferenceState::kOnlineReference;
}

/// True if the base is on a path, moving or at rest. [any]
constexpr bool on_path(Phase phase) {
  return phase >= Phase::kBraking && phase <= Phase::kStarving;
}

namespace detail {
/// The state after an event by the paper's figure; events that it does not have change nothing.
constexpr ReferenceState paper_says(ReferenceState state, MotionEvent event) {
  switch (event) {
    case MotionEvent::kPoint:
    case MotionEvent::kLeave:
    case MotionEvent::kStop: return next(state, ReferenceEvent::kNewReference);
    case MotionEvent::kTrajectory: return next(state, ReferenceEvent::kTrajectoryAccepted);
    case MotionEvent::kCancel: return next(state, ReferenceEvent::kTrajectoryCanceled);
    case MotionEvent::kComplete: return next(state, ReferenceEvent::kTrajectoryCompleted);
    default: return state;
  }
}
constexpr bool phases_are_the_papers() {
  for (std::size_t from = 0; from < kPhases; ++from) {
    for (std::size_t event = 0; event < kMotionEvents; ++event) {
      const auto phase = static_cast<Phase>(from);
      const auto what = static_cast<MotionEvent>(event);
      if (state_of(next(phase, what)) != paper_says(state_of(phase), what)) return false;
    }
  }
  return true;
}
}  // namespace detail
static_assert(detail::phases_are_the_papers());

}  // namespace tactus
