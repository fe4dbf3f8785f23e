// DriveMachine: takes one drive through the states of CiA 402 (IEC 61800-7-201, the power drive
// state machine): statusword in, controlword out, time passed in.
//
//   word := machine.step(statusword, goal, now)       in every cycle, from connecting on
//
// Every step is a request until the drive shows the state; a state that lasts longer than its time
// is late(). A drive is disabled by a quick stop, and by cutting its voltage if the stop takes too
// long. A fault is reset by pulses of 10 Hz, because drives can stop answering if it is toggled
// faster, and only on the way up.
#pragma once

#include <cstdint>

#include "hal/cia402/protocol.hpp"

namespace tactus::cia402 {

/// Where a drive is to be taken.
enum class Goal : std::uint8_t { kDisabled, kSwitchedOn, kOperationEnabled };

/// The longest times that a drive may take, ns.
struct DriveTimes {
  std::int64_t step_ns = 0;   ///< in one state on the way up
  std::int64_t reset_ns = 0;  ///< until a fault is reset
  std::int64_t stop_ns = 0;   ///< of a quick stop, before the voltage is cut
};

class DriveMachine {
 public:
  /// Falls on a way up that are bridged; Drives::judge_rise() reports it.
  static constexpr int kMostFalls = 3;

  /// Takes the time-outs. [init]
  void configure(const DriveTimes& times) { times_ = times; }

  /// Takes the newest statusword and returns the controlword that leads towards the goal. A new
  /// goal restarts the times. [cyclic]
  std::uint16_t step(std::uint16_t statusword, Goal goal, std::int64_t now_ns);

  State state() const { return state_; }
  /// True in the state of the goal, or, for kDisabled, in one without torque; a statusword that
  /// shows no state may hide any. [cyclic]
  bool reached() const;
  /// True after the time of the present state. [cyclic]
  bool late() const { return late_; }
  /// True if the drive went to fault on its way up, after a fault from before was reset. [cyclic]
  bool faulted() const;
  /// True if the drive has fallen back on its way up more than kMostFalls times: from one state to
  /// a lower one that is below the goal. [cyclic]
  bool falls_back() const { return falls_ > kMostFalls; }

 private:
  std::uint16_t stop_word() const;
  std::uint16_t enable_word(std::int64_t now_ns) const;
  std::int64_t limit_ns() const;

  DriveTimes times_;
  State state_ = State::kNotReadyToSwitchOn;
  Goal goal_ = Goal::kDisabled;
  std::int64_t since_ns_ = 0;  // in this state, with this goal
  bool left_fault_ = false;    // seen without a fault on this way up
  bool known_ = false;         // the statusword shows a state of the standard
  bool late_ = false;
  std::uint8_t falls_ = 0;  // on this way up, at most one more than are bridged
};

}  // namespace tactus::cia402
