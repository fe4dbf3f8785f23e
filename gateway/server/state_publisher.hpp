// StatePublisher: the cycles as clients see them. It takes the snapshots of the cycles, sends State
// and Feedback to the clients that have subscribed to them, and events about rungs and drives.
#pragma once

#include "gateway/server/clients.hpp"
#include "gateway/server/cycle_mailboxes.hpp"
#include "gateway/server/generator_clock.hpp"
#include "kernel/cycle/event_log.hpp"

namespace tactus {

class StatePublisher {
 public:
  /// `events` null: nothing is sent about drives; `hal` explains their codes.
  StatePublisher(const EventLog* events, const Hal* hal, CycleMailboxes& mailboxes,
                 References& references, StopCount& stops, Clients& clients)
      : events_(events),
        hal_(hal),
        mailboxes_(mailboxes),
        references_(references),
        stops_(stops),
        clients_(clients) {}

  /// Takes the snapshots of the cycles since the last call; the newest counts. A brake of the
  /// executive voids the references under way.
  void take_snapshots(std::int64_t now_ns);
  /// Sends what the event log has of drives: faults, also those from before an arming, and
  /// warnings. Events that were overwritten in the log are left out.
  void send_drive_events(std::int64_t now_ns);
  /// Sends the newest cycle to the clients whose State is due. `dropped`: references that were
  /// duplicates or overtaken.
  void send_states(const Lease& lease, std::uint32_t dropped, std::int64_t now_ns);
  void send_feedback(std::int64_t now_ns);

  /// The newest cycle; all zero before the first.
  const CycleSnapshot& newest() const { return newest_; }
  const GeneratorClock& clock() const { return clock_; }
  /// The reference of the joints; where they are measured, without a reference; infinity before the
  /// first cycle.
  JointVector present_joints() const;

 private:
  void send_state(Connection& to, const Lease& lease, std::uint32_t dropped);
  template <class Space>
  void send_feedback(const Feedback<Space>& feedback, ReferenceIntake<Space>& from,
                     std::int64_t now_ns);

  const EventLog* events_;
  const Hal* hal_;
  CycleMailboxes& mailboxes_;
  References& references_;
  StopCount& stops_;
  Clients& clients_;
  GeneratorClock clock_;
  CycleSnapshot newest_;
  bool seen_ = false;              // a snapshot
  std::uint32_t read_events_ = 0;  // of the executive's log
  std::uint32_t lost_feedback_ = 0;
};

}  // namespace tactus
