// ReferenceClient: the planner's end of a reference channel. It judges what it sends and keeps
// account of its stores. Runs outside the cycle; one client per channel.
#pragma once

#include <algorithm>
#include <array>

#include "gateway/chunk.hpp"
#include "gateway/part_account.hpp"
#include "gateway/state_history.hpp"
#include "kernel/reference/motion/admission_room.hpp"
#include "kernel/streams/stream_messages.hpp"

namespace tactus {

template <class Space>
class ReferenceClient {
 public:
  explicit ReferenceClient(ReferenceChannel<Space>& channel) : channel_(channel) {}

  /// Returns an empty store to fill with waypoints, or null while all are in use. It is the
  /// caller's until it is sent, or until the next acquire(), which may return the same store, empty
  /// again: one is filled at a time.
  Trajectory<Space>* acquire();
  /// The same for waypoints of these fields only, written by set(): more of them fit, up to
  /// the store's capacity. kMonotone needs velocities, though it chooses them itself.
  Trajectory<Space>* acquire(Fields fields);

  /// Writes into the waypoints what admission derives (see admit()) without sending them, and
  /// returns the verdict that send() would give. Like send(), it does not judge the way from the
  /// robot to the first waypoint.
  Verdict admit(Trajectory<Space>& trajectory) const;
  /// Admits and sends an acquired trajectory; its reports carry `id`. If it is refused, the store
  /// stays the caller's.
  Verdict send(Trajectory<Space>& trajectory, std::uint32_t& id);
  /// Judges one more waypoint of an open trajectory that was sent, and appends it. kWindowFull
  /// while the motion still needs all waypoints in the store; the trajectory is then unchanged.
  Verdict append(const Trajectory<Space>& trajectory, const Waypoint<Space>& waypoint);
  /// Sends the generator what was appended; after the `last` part nothing can be appended. Refuses
  /// the part as a whole, and drops it, if it must be slowed down too much. The motion uses it once
  /// the generator has taken it and a function of this client, such as poll(), has been called.
  Verdict flush(const Trajectory<Space>& trajectory, bool last, std::uint32_t& id);
  /// Returns the first waypoint of an open trajectory that the motion still needs.
  int needed(const Trajectory<Space>& trajectory) const {
    return channel_.needed[index_of(trajectory)].load(std::memory_order_acquire);
  }
  /// Returns how many whole waypoints a store holds. [init]
  int capacity() const { return channel_.stores[0].capacity; }
  /// Returns what trajectories are judged by.
  const AdmissionSettings<Space>& settings() const { return channel_.settings; }
  /// Admits and sends one online point; `header` has the joints it leaves out, or its frames.
  /// kReferenceNotFinite also for its stamp.
  Verdict send(const typename Space::Point& point, std::uint32_t& id,
               const typename Space::Header& header = {}, const PointDetails& details = {});
  /// Judges, fits and sends a chunk (gateway/chunk.hpp). kReferenceTime also for relative targets
  /// whose observation is not in the history; kNoFreeStore while all chunks are in use. Its report
  /// is executed, superseded, or refused: kChunkLate, kEpochVoid.
  Verdict send(const Chunk<Space>& chunk, std::uint32_t& id);
  /// Sends a velocity; `header` has the joints it leaves out, or its frame.
  Verdict send(const Velocity<Space>& velocity, std::uint32_t& id,
               const typename Space::Header& header = {});
  /// Counters and margins of chunks and velocities.
  const StreamState& stream() const;
  /// Gives up everything that was sent before: a trajectory stops on its path, a motion to a point
  /// comes to rest.
  Verdict cancel(std::uint32_t& id) { return control(ControlKind::kCancel, id); }

  /// Passes trajectories at `rate`, 0..1, times their speed from now on.
  Verdict set_override(double rate, std::uint32_t& id) {
    return control(ControlKind::kOverride, id, rate);
  }
  /// The same, but refuses a rate above the one in force.
  Verdict slow_down(double rate, std::uint32_t& id) {
    return control(ControlKind::kSlowDown, id, rate);
  }
  /// pause() stops on the path and keeps the trajectory; resume() continues it.
  Verdict pause(std::uint32_t& id) { return control(ControlKind::kPause, id); }
  Verdict resume(std::uint32_t& id) { return control(ControlKind::kResume, id); }

  /// Controls whose final reports were not fetched.
  std::size_t unanswered() const {
    return kControls - static_cast<std::size_t>(
                           std::count(unanswered_.begin(), unanswered_.end(), std::uint32_t{0}));
  }

  /// Conditions under which a goal counts as reached, unless it says otherwise; null before the
  /// generator has started.
  const Tolerances<Space>* tolerances() const { return channel_.tolerances; }
  /// Judges whether the robot had reached a goal at the time of this feedback, as the generator
  /// does, but for its latency and dwell time: kGoalTolerance, kGoalVelocity.
  Verdict judge_goal(const Feedback<Space>& feedback) const;

  /// Takes the next report; false if there is none. Frees the store that the report returns.
  bool poll(Report& report);
  /// Takes the oldest message of feedback; false if there is none. Relative chunks need it to be
  /// called regularly.
  bool poll_feedback(Feedback<Space>& feedback);

 private:
  /// The client's account of an open trajectory; the count in the trajectory belongs to the
  /// generator once it is sent.
  struct Stream {
    PartAccount<Space> parts;
    int settled = 0;     // waypoints whose rooms are set
    bool whole = false;  // no more waypoints follow those settled
  };

  std::size_t index_of(const Trajectory<Space>& trajectory) const {
    return static_cast<std::size_t>(&trajectory - channel_.stores.data());
  }
  Verdict control(ControlKind kind, std::uint32_t& id, double rate = 1.0);
  void settle(std::size_t store);
  Verdict post(Request<Space> request, std::uint32_t& id);
  Verdict post(const Chunk<Space>& chunk, std::uint32_t& id);

  ReferenceChannel<Space>& channel_;
  std::array<bool, kStores> away_{};  // sent and not yet returned by a report
  std::array<Stream, kStores> streams_{};
  std::uint32_t next_id_ = 1;
  std::array<std::uint32_t, kControls> unanswered_{};  // numbers of controls; 0: none
  OnlyWithStreams<StateHistory<Space>> history_;
  OnlyWithStreams<Chunk<Space>> resolved_;  // a relative chunk in positions
};

}  // namespace tactus
