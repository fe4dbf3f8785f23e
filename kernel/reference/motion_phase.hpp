// The phases of a reference's motion: what the two states of the paper's figure are made of, and
// what leads from one to the other.
//
//   online       holding    stands, and will until told otherwise
//                reaching   on its way to a point, or with a stream of them
//                stopping   on the fastest way to rest, wherever that is
//                braking    on the path of a trajectory that was given up, until it rests
//   trajectory   joining    its path runs; the reference is on its way to it
//                following  on the path
//                paused     the path is brought to rest, and waits
//                starving   an open path has run out of waypoints, and waits
//                settling   the path has ended; the robot is to arrive
#pragma once

#include <array>

#include "kernel/reference/reference_state.hpp"

namespace tactus {

enum class Phase : std::uint8_t {
  kHolding,
  kReaching,
  kStopping,
  kBraking,
  kJoining,
  kFollowing,
  kPaused,
  kStarving,
  kSettling,
};

enum class MotionEvent : std::uint8_t {
  kPoint,       ///< a point to go to, or to be put out
  kStop,        ///< come to rest at once
  kTrajectory,  ///< one was accepted
  kCancel,      ///< come to rest on the path, if there is one
  kComplete,    ///< the robot has arrived
  kJoined,      ///< the reference is on its path
  kPause,
  kResume,
  kDry,     ///< an open path stands at its end so far
  kFed,     ///< it goes on
  kEnd,     ///< the path has ended, or rests while it is given up
  kAtRest,  ///< nothing moves any more
};

inline constexpr std::size_t kPhases = 9, kMotionEvents = 12;
inline constexpr std::array<const char*, kPhases> kPhaseNames = {"holding", "reaching", "stopping",
                                                                 "braking", "joining",  "following",
                                                                 "paused",  "starving", "settling"};

namespace detail {
using P = Phase;
// clang-format off
inline constexpr std::array<std::array<Phase, kMotionEvents>, kPhases> kPhaseTable = {{
    //           kPoint        kStop         kTrajectory  kCancel       kComplete     kJoined        kPause        kResume       kDry          kFed          kEnd          kAtRest
    /*holding*/  {P::kReaching, P::kHolding,  P::kJoining, P::kHolding,  P::kHolding,  P::kHolding,   P::kHolding,  P::kHolding,  P::kHolding,  P::kHolding,  P::kHolding,  P::kHolding},
    /*reaching*/ {P::kReaching, P::kStopping, P::kJoining, P::kStopping, P::kReaching, P::kReaching,  P::kReaching, P::kReaching, P::kReaching, P::kReaching, P::kReaching, P::kHolding},
    /*stopping*/ {P::kReaching, P::kStopping, P::kJoining, P::kStopping, P::kStopping, P::kStopping,  P::kStopping, P::kStopping, P::kStopping, P::kStopping, P::kStopping, P::kHolding},
    /*braking*/  {P::kReaching, P::kStopping, P::kJoining, P::kBraking,  P::kBraking,  P::kBraking,   P::kBraking,  P::kBraking,  P::kBraking,  P::kBraking,  P::kReaching, P::kBraking},
    /*joining*/  {P::kReaching, P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kFollowing, P::kPaused,   P::kJoining,  P::kStarving, P::kJoining,  P::kSettling, P::kJoining},
    /*following*/{P::kReaching, P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kFollowing, P::kPaused,   P::kFollowing,P::kStarving, P::kFollowing,P::kSettling, P::kFollowing},
    /*paused*/   {P::kReaching, P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kPaused,    P::kPaused,   P::kJoining,  P::kPaused,   P::kPaused,   P::kSettling, P::kPaused},
    /*starving*/ {P::kReaching, P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kStarving,  P::kPaused,   P::kStarving, P::kStarving, P::kJoining,  P::kSettling, P::kStarving},
    /*settling*/ {P::kReaching, P::kStopping, P::kJoining, P::kReaching, P::kReaching, P::kSettling,  P::kSettling, P::kSettling, P::kSettling, P::kSettling, P::kSettling, P::kSettling},
}};
// clang-format on
}  // namespace detail

/// The phase after `event`. [any]
constexpr Phase next(Phase phase, MotionEvent event) {
  return detail::kPhaseTable[static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
}

/// The paper's state that a phase belongs to. [any]
constexpr ReferenceState state_of(Phase phase) {
  return phase >= Phase::kJoining ? ReferenceState::kTrajectoryExecution
                                  : ReferenceState::kOnlineReference;
}

/// A path is run along, or stood on. [any]
constexpr bool on_path(Phase phase) {
  return phase >= Phase::kBraking && phase <= Phase::kStarving;
}

namespace detail {
/// What the event is in the paper's figure; the others change nothing there.
constexpr ReferenceState paper_says(ReferenceState state, MotionEvent event) {
  switch (event) {
    case MotionEvent::kPoint:
    case MotionEvent::kStop:
      return next(state, ReferenceEvent::kNewReference);
    case MotionEvent::kTrajectory:
      return next(state, ReferenceEvent::kTrajectoryAccepted);
    case MotionEvent::kCancel:
      return next(state, ReferenceEvent::kTrajectoryCanceled);
    case MotionEvent::kComplete:
      return next(state, ReferenceEvent::kTrajectoryCompleted);
    default:
      return state;
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
