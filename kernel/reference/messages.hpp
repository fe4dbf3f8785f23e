// What a client sends to a reference generator and what comes back. Every request ends in exactly
// one final report.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "kernel/mailbox.hpp"
#include "kernel/reference/feedback.hpp"
#include "kernel/reference/trajectory.hpp"
#include "kernel/reference/verdict.hpp"

namespace tactus {

enum class RequestKind : std::uint8_t {
  kPoint,       ///< this reference from now on
  kTrajectory,  ///< follow the trajectory in a store
  kCancel,      ///< stop on the path and hold
  kOverride,    ///< pass trajectories at a fraction of their speed
  kPause,       ///< stop on the path, the trajectory stays alive
  kResume,      ///< go on after a pause
  kAppend,      ///< the open trajectory in a store has become longer
};

template <class Space>
struct Request {
  std::uint32_t id = 0;  ///< the client's number, returned in every report
  RequestKind kind = RequestKind::kPoint;
  int store = -1;               ///< kTrajectory: which store it lies in
  typename Space::Point point;  ///< kPoint
  typename Space::Terms terms;  ///< kPoint: which joints, or which frames, it is given in
  double rate = 1.0;            ///< kOverride: 0..1
  int count = 0;                ///< kAppend: waypoints so far
  bool last = false;            ///< kAppend: none will follow
  typename Space::Use use;      ///< kAppend: what the new part takes
};

enum class Outcome : std::uint8_t {
  kScheduled,   ///< a trajectory waits for its start time; a final report follows
  kStarted,     ///< a trajectory began; a final report follows
  kSucceeded,   ///< final: a trajectory reached its end
  kPreempted,   ///< final: a newer trajectory took its place
  kAborted,     ///< final: an online point took its place, a tolerance was violated, or the
                ///< executive brakes; the verdict says why
  kCanceled,    ///< final: a client cancelled the trajectory
  kExecuted,    ///< final: a point became the reference; a cancel, override, pause or resume took
                ///< effect
  kSuperseded,  ///< final: a newer point took its place before it was ever written, or a newer
                ///< trajectory before its start time
  kRefused,     ///< final: not accepted; the verdict says why
  kStarved,   ///< an open trajectory ran out of waypoints: the arm stops on the path and waits for
              ///< more
  kReleased,  ///< a store is the client's again, after a final report that did not give it back
};

/// The name of an outcome, for example "succeeded". Never null. [any]
const char* name(Outcome outcome);

struct Report {
  std::uint32_t id = 0;
  Outcome outcome = Outcome::kRefused;
  int store =
      -1;  ///< a store that is the client's again; -1 while the arm still brakes on its path
  Verdict verdict;
  double time_s = 0.0;  ///< by the generator's clock, periods since its start
};

/// What admission goes by: the same values on both sides of the channel, set when the pipeline is
/// loaded.
template <class Space>
struct AdmissionSettings {
  typename Space::Limits limits;
  double period_s = 0.0;
  /// Fraction of acceleration and jerk limits that a trajectory leaves free, so that it can be
  /// stopped on its path at any time.
  double stop_reserve = 0.02;
  /// How much longer a trajectory may become by being slowed down where it is beyond a limit, as a
  /// fraction.
  double max_stretch = 0.1;
};

/// One running, one waiting for its start time or in the mailbox, one being filled.
inline constexpr int kStores = 3;

/// The way into one reference generator and back out. Owned by the board; one client, one
/// generator.
template <class Space>
struct ReferenceChannel {
  AdmissionSettings<Space> settings;
  Mailbox<Request<Space>, 16> requests;
  Mailbox<Report, 64> reports;
  FeedbackMailbox<Space> feedback;
  std::array<Trajectory<Space>, kStores> stores;
  /// First waypoint of each store that the motion still needs; those before may be overwritten.
  std::array<std::atomic<int>, kStores> needed{};
  /// Waypoints of each store that the generator knows of; their negative when none will follow.
  std::array<std::atomic<int>, kStores> known{};
};

}  // namespace tactus
