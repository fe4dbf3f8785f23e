// The messages between a client and a reference generator. Every request and every control gets
// exactly one final report. On a board with streams, kernel/streams/stream_messages.hpp completes
// them.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "kernel/core/mailbox.hpp"
#include "kernel/core/streams.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/reference/generator/feedback.hpp"
#include "kernel/reference/motion/admission_settings.hpp"
#include "kernel/reference/motion/trajectory.hpp"

namespace tactus {

enum class RequestKind : std::uint8_t {
  kPoint,       ///< make this point the reference
  kTrajectory,  ///< follow the trajectory in a store
  kAppend,      ///< take up waypoints appended to the open trajectory in a store
  kChunk,       ///< go along with the curve in a store of chunks
  kVelocity,    ///< move at a velocity
};

// Defined in kernel/streams.
template <class Space>
struct ChunkStores;
template <class Space>
struct StreamRequest;

template <class Space>
struct Request : OnlyWithStreams<StreamRequest<Space>> {
  std::uint32_t id = 0;  ///< the client's number, returned in every report
  RequestKind kind = RequestKind::kPoint;
  int store = -1;                 ///< kTrajectory, kAppend, kChunk: the store of its kind
  typename Space::Point point;    ///< kPoint
  typename Space::Header header;  ///< kPoint, kVelocity: joints left out, or frames it is given in
  int count = 0;                  ///< kAppend: all waypoints including the new ones
  bool last = false;              ///< kAppend: none will follow
  typename Space::Extent extent;  ///< kAppend: extent of the new part
};

enum class ControlKind : std::uint8_t {
  kCancel,    ///< stop and hold; void everything that was sent before
  kOverride,  ///< pass trajectories at a fraction of their speed
  kPause,     ///< stop on the path and keep the trajectory
  kResume,    ///< go on after a pause
  kSlowDown,  ///< as kOverride, from a client that may only slow the arm down
};

/// A command that must never wait for a point, a trajectory or an unread report.
/// Controls and requests share one sequence of numbers.
struct Control {
  std::uint32_t id = 0;
  ControlKind kind = ControlKind::kCancel;
  double rate = 1.0;  ///< kOverride, kSlowDown: 0..1
};

enum class Outcome : std::uint8_t {
  kScheduled,   ///< a trajectory waits for its start time; a final report follows
  kStarted,     ///< a trajectory began; a final report follows
  kSucceeded,   ///< final: a trajectory reached its end
  kPreempted,   ///< final: a newer trajectory replaced it
  kAborted,     ///< final: an online point replaced it, a tolerance was violated, or the
                ///< executive brakes; the verdict has the reason
  kCanceled,    ///< final: a client cancelled the trajectory
  kExecuted,    ///< final: a point, a chunk or a velocity took effect; a cancel, override, pause or
                ///< resume took effect
  kSuperseded,  ///< final: a newer point replaced it before it took effect, or a newer trajectory
                ///< before its start time; or a cancel voided a point
  kRefused,     ///< final: not accepted; the verdict has the reason
  kStarved,   ///< an open trajectory ran out of waypoints, or an executed chunk or velocity was not
              ///< followed by another in time: the arm comes to rest and waits for more
  kReleased,  ///< a store is the client's again, after a final report that did not return it
};

constexpr const char* name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kScheduled: return "scheduled";
    case Outcome::kStarted: return "started";
    case Outcome::kSucceeded: return "succeeded";
    case Outcome::kPreempted: return "preempted";
    case Outcome::kAborted: return "aborted";
    case Outcome::kCanceled: return "canceled";
    case Outcome::kExecuted: return "executed";
    case Outcome::kSuperseded: return "superseded";
    case Outcome::kRefused: return "refused";
    case Outcome::kStarved: return "starved";
    case Outcome::kReleased: return "released";
  }
  return nullptr;
}

/// True if no report on the same request follows, but for the release of its store.
constexpr bool is_final(Outcome outcome) {
  return outcome != Outcome::kScheduled && outcome != Outcome::kStarted &&
         outcome != Outcome::kStarved && outcome != Outcome::kReleased;
}

struct Report {
  std::uint32_t id = 0;
  Outcome outcome = Outcome::kRefused;
  int store =
      -1;  ///< the store returned to the client; -1: none, or the arm still brakes on its path
  Verdict verdict;
  double time_s = 0.0;  ///< by the generator's clock, periods since its start
};

/// One for the running trajectory, one for a trajectory that waits for its start time or in the
/// mailbox, one to fill.
inline constexpr int kStores = 3;

/// Largest number of unanswered controls: sent, and their final reports not yet fetched.
inline constexpr std::size_t kControls = 16;

/// Most requests that a mailbox holds.
inline constexpr std::uint32_t kMostRequests = 16;

// One request causes at most four reports in its cycle: on the request that it supersedes, on a
// trajectory that ends, on a released store, and its own. The running and the waiting reference
// cause six more later: a point, a trajectory that ends and its store, one that starts and ends and
// its store. A request waits in its mailbox until there is space for all of them and for one report
// of every control that can be unanswered, so no report is ever lost.
inline constexpr std::size_t kReportsPerRequest = 10;

/// The messages and stores between one client and one reference generator. The board owns it, with
/// its mailboxes, as a ChannelMemory.
template <class Space>
struct ReferenceChannel : OnlyWithStreams<ChunkStores<Space>> {
  ReferenceChannel(MessageQueue<Request<Space>>& its_requests, MessageQueue<Report>& its_reports,
                   FeedbackQueue<Space>& its_feedback)
      : requests(its_requests), reports(its_reports), feedback(its_feedback) {}

  AdmissionSettings<Space> settings;
  const Tolerances<Space>* tolerances = nullptr;  ///< the generator's defaults; set by its start
  MessageQueue<Request<Space>>& requests;
  Mailbox<Control, kControls> controls;  ///< all are taken in every cycle
  MessageQueue<Report>& reports;
  FeedbackQueue<Space>& feedback;
  std::array<Trajectory<Space>, kStores> stores;
  /// First waypoint of each store that the motion still needs; earlier ones may be overwritten.
  std::array<std::atomic<int>, kStores> needed{};
  /// Number of waypoints of each store that the generator has received; negative if none will
  /// follow.
  std::array<std::atomic<int>, kStores> known{};
};

/// A channel with its mailboxes. A board with little memory makes them smaller: requests and
/// feedback for as many cycles as its client may be late, and reports for as many requests as may
/// be unanswered at once.
template <class Space, std::uint32_t kRequests = kMostRequests, std::uint32_t kReports = 64,
          std::uint32_t kFeedback = 16>
struct ChannelMemory : ReferenceChannel<Space> {
  static_assert(kRequests <= kMostRequests, "a cycle takes no more");
  static_assert(kReports >= kReportsPerRequest + kControls, "no request would ever be taken");

  ChannelMemory() : ReferenceChannel<Space>(request_box, report_box, feedback_box) {}

  Mailbox<Request<Space>, kRequests> request_box;
  Mailbox<Report, kReports> report_box;
  Mailbox<Feedback<Space>, kFeedback> feedback_box;
};

}  // namespace tactus
