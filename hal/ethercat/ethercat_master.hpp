// EthercatMaster: seven drives on one segment, without the interface: frames in, frames out, time
// passed in. EthercatHal carries the frames.
//
// A cycle: receive() takes what has arrived since the last one; read() judges it; write() composes
// the frame of this cycle. A drive gives its newest samples into that frame and takes its command
// out of it, so a command acts exactly one period after the sample that it answers.
#pragma once

#include <algorithm>

#include "hal/cia402/drives.hpp"
#include "hal/ethercat/cyclic_frame.hpp"
#include "hal/ethercat/segment_clock.hpp"
#include "hal/ethercat/startup.hpp"

namespace tactus::ethercat {

class EthercatMaster {
 public:
  EthercatMaster() : port_(coe_), startup_(slaves_, coe_, why_) {}

  /// Takes the settings, which must outlive the master. kMissingKey, kBadValue, kTooLarge; `why`
  /// names key, value and limit. [init]
  Status configure(const EthercatSettings& ethercat, const cia402::Cia402Settings& drive,
                   const Tool& tool, CommandMode mode, int period_us, int arming_ms);
  const char* interface() const { return ethercat_->interface.c_str(); }

  /// Begins the start-up with the sender's Ethernet address; connecting() is called until it does
  /// not return kArming. [init]
  void connect(const std::uint8_t* source, std::int64_t now_ns);
  Status connecting(std::int64_t now_ns);

  /// Takes a frame that has arrived. [init, cyclic]
  void receive(Frame& frame);
  /// True while a frame is to return. [any]
  bool awaits() const { return state_ == MasterState::kStartingUp || cyclic_.awaits(); }
  /// True while the wire answers: no more frames in a row are missing than [cia402] max_missed, or
  /// than two where drives are to be disabled. [cyclic]
  bool answers() const {
    const int most = drive_->max_missed;
    return cyclic_.missing() <= (stops_ ? std::min(most, kMostUnanswered) : most);
  }
  /// Judges what has arrived since the last cycle. [cyclic]
  Status read(const CycleTime& now, RobotState& state);
  /// Composes the frame of this cycle. [cyclic]
  void write(const RobotCommand& command);
  /// Copies the frame to send; false: there is none. [init, cyclic]
  bool take(Frame& frame);

  /// True from connecting to leave(). [any]
  bool connected() const { return state_ == MasterState::kConnected; }
  int period_us() const { return period_us_; }
  int stop_ms() const { return drive_->stop_ms; }
  bool confirmed(int joint) const { return drives_.confirmed(joint); }
  bool lost(int joint) const { return slave(joint).feedback.lost != Status::kOk; }
  const Slave& slave(int joint) const { return slaves_[static_cast<std::size_t>(joint)]; }
  Message label(int joint) const { return ethercat::label(joint, slave(joint)); }
  const LineCounts& counts() const { return cyclic_.counts(); }
  const ClockSteer& steer() const { return steer_; }
  /// With SYNC0: how the frames of the cycles came before it; without: nothing has been seen. [any]
  const Sync0Watch& sync0() const { return sync0_; }
  /// As ClockSetup::apart_ns(). [any]
  std::int64_t apart_ns() const { return startup_.clock().apart_ns(); }
  /// The moment next to `near_ns`, in the time of connecting(), at which a frame is in step with
  /// SYNC0; without SYNC0 any is. [init]
  std::int64_t in_step(std::int64_t near_ns) const;
  /// Time until connecting() sends its next frame by itself, ns; 0: it waits for an answer. [init]
  std::int64_t until_due_ns(std::int64_t now_ns) const {
    return state_ == MasterState::kEnteringOp ? std::max(due_ns_ - now_ns, std::int64_t{0}) : 0;
  }
  cia402::ArmingPhase phase() const { return drives_.phase(); }
  /// Leaves a frame that takes all slaves to INIT; the exchange is over. [any]
  void leave();

  Message& why() { return why_; }
  /// The last Status in words. [between two cycles]
  Message trouble() const;
  /// As Hal::unstated(). [init]
  Message unstated() const { return cia402::unstated(*drive_, startup_.findings()); }
  /// As cia402::written_text(), of all start-ups. [init]
  Message written(int n) const { return cia402::written_text(drive_->sdo, startup_.findings(), n); }
  /// As Drives::to_home(). [init]
  Message to_home() const { return drives_.to_home(); }

 private:
  enum class MasterState : std::uint8_t { kOff, kStartingUp, kEnteringOp, kConnected };

  static constexpr auto kOperational = static_cast<std::uint16_t>(AlState::kOp);
  static constexpr int kSteady = 5;     // cycles in a row with inputs before it is connected
  static constexpr int kBeforeOp = 10;  // cycles with outputs before OP is requested
  static constexpr int kAgain = 100;    // cycles after which it is requested again
  static constexpr int kMostUnanswered = 2;

  std::int64_t period_ns() const { return std::int64_t{1000} * period_us_; }
  std::int64_t slack_ns() const { return period_ns() * (drive_->max_missed + 1); }
  // ethercat_master.cpp
  Status judge_places();
  Status judge_times();
  Status operating(std::int64_t now_ns);
  void take_cycle();
  void take_state();
  void take_mailbox();
  void compose(const cia402::DriveCommands& commands, const Request* extra);
  // ethercat_modes.cpp
  void carry_request();
  void start_clock(std::int64_t slack_ns);
  void start_steering();
  CyclicFrame::Arrival close_cycle(std::int64_t sent_ns, std::int64_t now_ns);
  Message clock_text() const;
  Status not_operating();

  const EthercatSettings* ethercat_ = nullptr;
  const cia402::Cia402Settings* drive_ = nullptr;
  CommandMode mode_ = CommandMode::kEffort;
  int period_us_ = 1;
  Slaves slaves_;
  CoeClient coe_;
  MailboxPort port_;
  Message why_;
  Startup startup_;
  CyclicFrame cyclic_;
  ClockSteer steer_;
  ReferenceClock clock_;
  Sync0Watch sync0_;
  cia402::Drives drives_;
  cia402::DriveCommands commands_;
  MasterState state_ = MasterState::kOff;
  Frame out_;
  bool has_out_ = false, arrived_ = false, own_extra_ = false;
  bool stops_ = false;  // the drives are to be disabled
  int steady_ = 0, cycles_ = 0;
  std::int64_t since_ns_ = 0, sent_ns_ = 0, due_ns_ = 0;
  std::int64_t in_step_ns_ = 0;  // when a frame was, or would have been, in step with SYNC0
  std::int64_t now_ns_ = -1, sampled_ns_ = 0;
  int asked_ = 0;    // slave whose state is read
  int boxed_ = 0;    // slave whose mailbox is served
  int carried_ = 0;  // number of the request that is under way; 0: none
};

}  // namespace tactus::ethercat
