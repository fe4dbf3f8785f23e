// The phases of a reference's motion, which make up the two states of the paper's figure, and the
// events that lead from one to another.
//
//   online       holding    at rest until the next request
//                reaching   on the way to a point, or along with a stream of points
//                tracking   along the curves of chunks
//                expiring   the same, to rest at the end of the last one: no successor has arrived
//                driving    at a given velocity, or coming to rest when it is not renewed
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
#include <cstdint>

#include "kernel/core/names.hpp"

namespace tactus {

/// The two states of the paper's figure, and its transitions.
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

enum class MotionPhase : std::uint8_t {
  kHolding,
  kReaching,
  kTracking,
  kExpiring,
  kDriving,
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
  kDry,       ///< an open path is at rest at its present end
  kFed,       ///< an open path moves again
  kEnd,       ///< the path has ended, or has come to rest after it was given up
  kChunk,     ///< a chunk to go along with
  kVelocity,  ///< a velocity to move at
  kExpire,    ///< the last chunk ends and has no successor
  kAtRest,    ///< the reference has come to rest
};

constexpr const char* name(MotionPhase phase) {
  switch (phase) {
    case MotionPhase::kHolding: return "holding";
    case MotionPhase::kReaching: return "reaching";
    case MotionPhase::kTracking: return "tracking";
    case MotionPhase::kExpiring: return "expiring";
    case MotionPhase::kDriving: return "driving";
    case MotionPhase::kStopping: return "stopping";
    case MotionPhase::kBraking: return "braking";
    case MotionPhase::kLeaving: return "leaving";
    case MotionPhase::kJoining: return "joining";
    case MotionPhase::kFollowing: return "following";
    case MotionPhase::kPaused: return "paused";
    case MotionPhase::kStarving: return "starving";
    case MotionPhase::kSettling: return "settling";
  }
  return nullptr;
}

inline constexpr std::size_t kPhases = kNames<MotionPhase>.size();
inline constexpr std::size_t kMotionEvents = static_cast<std::size_t>(MotionEvent::kAtRest) + 1;

namespace detail {
using P = MotionPhase;
// clang-format off
inline constexpr std::array<std::array<MotionPhase, kMotionEvents>, kPhases> kPhaseTable = {{
    //            kPoint        kLeave        kStop         kTrajectory  kCancel       kComplete     kJoined        kPause        kResume        kDry          kFed           kEnd          kChunk        kVelocity    kExpire        kAtRest
    /*holding*/  {P::kReaching, P::kHolding,  P::kHolding,  P::kJoining, P::kHolding,  P::kHolding,  P::kHolding,   P::kHolding,  P::kHolding,   P::kHolding,  P::kHolding,   P::kHolding,  P::kTracking, P::kDriving, P::kHolding,   P::kHolding},
    /*reaching*/ {P::kReaching, P::kReaching, P::kStopping, P::kJoining, P::kStopping, P::kReaching, P::kReaching,  P::kReaching, P::kReaching,  P::kReaching, P::kReaching,  P::kReaching, P::kTracking, P::kDriving, P::kReaching,  P::kHolding},
    /*tracking*/ {P::kReaching, P::kTracking, P::kStopping, P::kJoining, P::kStopping, P::kTracking, P::kTracking,  P::kTracking, P::kTracking,  P::kTracking, P::kTracking,  P::kTracking, P::kTracking, P::kDriving, P::kExpiring,  P::kHolding},
    /*expiring*/ {P::kReaching, P::kExpiring, P::kStopping, P::kJoining, P::kStopping, P::kExpiring, P::kExpiring,  P::kExpiring, P::kExpiring,  P::kExpiring, P::kExpiring,  P::kExpiring, P::kTracking, P::kDriving, P::kExpiring,  P::kHolding},
    /*driving*/  {P::kReaching, P::kDriving,  P::kStopping, P::kJoining, P::kStopping, P::kDriving,  P::kDriving,   P::kDriving,  P::kDriving,   P::kDriving,  P::kDriving,   P::kDriving,  P::kTracking, P::kDriving, P::kDriving,   P::kHolding},
    /*stopping*/ {P::kReaching, P::kStopping, P::kStopping, P::kJoining, P::kStopping, P::kStopping, P::kStopping,  P::kStopping, P::kStopping,  P::kStopping, P::kStopping,  P::kStopping, P::kTracking, P::kDriving, P::kStopping,  P::kHolding},
    /*braking*/  {P::kReaching, P::kLeaving,  P::kStopping, P::kJoining, P::kBraking,  P::kBraking,  P::kBraking,   P::kBraking,  P::kBraking,   P::kBraking,  P::kBraking,   P::kReaching, P::kTracking, P::kDriving, P::kBraking,   P::kBraking},
    /*leaving*/  {P::kReaching, P::kLeaving,  P::kStopping, P::kJoining, P::kBraking,  P::kLeaving,  P::kLeaving,   P::kLeaving,  P::kLeaving,   P::kLeaving,  P::kLeaving,   P::kReaching, P::kTracking, P::kDriving, P::kLeaving,   P::kLeaving},
    /*joining*/  {P::kReaching, P::kLeaving,  P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kFollowing, P::kPaused,   P::kJoining,   P::kStarving, P::kJoining,   P::kSettling, P::kTracking, P::kDriving, P::kJoining,   P::kJoining},
    /*following*/{P::kReaching, P::kLeaving,  P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kFollowing, P::kPaused,   P::kFollowing, P::kStarving, P::kFollowing, P::kSettling, P::kTracking, P::kDriving, P::kFollowing, P::kFollowing},
    /*paused*/   {P::kReaching, P::kLeaving,  P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kPaused,    P::kPaused,   P::kJoining,   P::kPaused,   P::kPaused,    P::kSettling, P::kTracking, P::kDriving, P::kPaused,    P::kPaused},
    /*starving*/ {P::kReaching, P::kLeaving,  P::kStopping, P::kJoining, P::kBraking,  P::kReaching, P::kStarving,  P::kPaused,   P::kStarving,  P::kStarving, P::kJoining,   P::kSettling, P::kTracking, P::kDriving, P::kStarving,  P::kStarving},
    /*settling*/ {P::kReaching, P::kReaching, P::kStopping, P::kJoining, P::kReaching, P::kReaching, P::kSettling,  P::kSettling, P::kSettling,  P::kSettling, P::kSettling,  P::kSettling, P::kTracking, P::kDriving, P::kSettling,  P::kSettling},
}};
// clang-format on
}  // namespace detail

/// Returns the phase after `event`. [any]
constexpr MotionPhase next(MotionPhase phase, MotionEvent event) {
  return detail::kPhaseTable[static_cast<std::size_t>(phase)][static_cast<std::size_t>(event)];
}

/// Returns the paper's state that a phase belongs to. [any]
constexpr ReferenceState state_of(MotionPhase phase) {
  return phase >= MotionPhase::kJoining ? ReferenceState::kTrajectoryExecution
                                        : ReferenceState::kOnlineReference;
}

/// True if the base is on a path, moving or at rest. [any]
constexpr bool on_path(MotionPhase phase) {
  return phase >= MotionPhase::kBraking && phase <= MotionPhase::kStarving;
}

/// True if chunks or a velocity move the reference. [any]
constexpr bool streams(MotionPhase phase) {
  return phase >= MotionPhase::kTracking && phase <= MotionPhase::kDriving;
}

namespace detail {
/// The state after an event by the paper's figure; events that it does not have change nothing.
constexpr ReferenceState paper_says(ReferenceState state, MotionEvent event) {
  switch (event) {
    case MotionEvent::kPoint:
    case MotionEvent::kLeave:
    case MotionEvent::kChunk:
    case MotionEvent::kVelocity:
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
      const auto phase = static_cast<MotionPhase>(from);
      const auto what = static_cast<MotionEvent>(event);
      if (state_of(next(phase, what)) != paper_says(state_of(phase), what)) return false;
    }
  }
  return true;
}
}  // namespace detail
static_assert(detail::phases_are_the_papers());

}  // namespace tactus
