// CanMaster: seven drives behind one to four CAN buses, without the buses: frames in, frames out,
// time passed in. CanHal carries the frames.
//
// A cycle: receive() takes the frames since the last one; read() judges them; write() leaves the
// frames of this cycle in the outboxes, SYNC last. A drive applies its command and samples its
// feedback at that SYNC, so a command acts exactly one period after the sample that it answers.
#pragma once

#include "hal/can/bus_load.hpp"
#include "hal/can/can_filter.hpp"
#include "hal/can/startup.hpp"
#include "hal/cia402/drives.hpp"

namespace tactus::can {

class CanMaster {
 public:
  static constexpr int kMaxFilters = 5 * kDof + 3;

  /// Takes the settings, which must outlive the master. kBadValue, kTooLarge, kOverBudget for
  /// buses that cannot carry a cycle; `why` names key, value and limit. [init]
  Status configure(const CanSettings& can, const cia402::Cia402Settings& drive, const Tool& tool,
                   CommandMode mode, int period_us, int arming_ms);

  int buses() const { return buses_; }
  /// Name of a bus, from 0. [init]
  const char* interface(int bus) const {
    return interfaces_[static_cast<std::size_t>(bus)].c_str();
  }
  /// Lists what a bus needs to receive; returns the number of filters. [init]
  int filters(int bus, std::array<CanFilter, kMaxFilters>& filters) const;

  /// Begins the start-up; connecting() is called until it does not return kArming. [init]
  void connect(std::int64_t now_ns);
  Status connecting(std::int64_t now_ns);
  /// Bus that answers are awaited from while connecting. [init]
  int awaited_bus() const { return startup_.bus(); }

  /// Takes a frame received on a bus. [init, cyclic]
  void receive(int bus, const CanFrame& frame, std::int64_t now_ns);
  /// Judges the frames received since the last cycle. kBusConflict: another master commands the
  /// drives.
  /// [cyclic]
  Status read(const CycleTime& now, RobotState& state);
  /// Leaves the frames of this cycle in the outboxes. [cyclic]
  void write(const RobotCommand& command);
  /// True from connecting to leave(). [any]
  bool connected() const { return connected_; }
  int period_us() const { return period_us_; }
  int stop_ms() const { return drive_->stop_ms; }
  /// True if a drive has confirmed that it is disabled; true if a drive was lost. [any]
  bool confirmed(int joint) const { return drives_.confirmed(joint); }
  bool lost(int joint) const { return node(joint).feedback.lost != Status::kOk; }
  const Node& node(int joint) const { return nodes_[static_cast<std::size_t>(joint)]; }
  Message label(int joint) const { return can::label(joint, node(joint)); }
  /// Makes every write() end one drive's heartbeat supervision of this program, or take one drive
  /// out of operation, until releasing() is false. [any]
  void release_drives() { releases_ = 2 * kDof; }
  bool releasing() const { return releases_ > 0; }
  /// Leaves frames that stop the drives; the exchange is over. [any]
  void leave();
  Outbox& outbox(int bus) { return out_[static_cast<std::size_t>(bus)]; }

  Message& why() { return why_; }
  /// The last Status in words. [between two cycles]
  Message trouble() const;
  /// As Hal::unstated(). [init]
  Message unstated() const { return cia402::unstated(*drive_, startup_.findings()); }
  /// As cia402::written_text(), of all start-ups. [init]
  Message written(int n) const { return cia402::written_text(drive_->sdo, startup_.findings(), n); }
  /// As Drives::to_home(). [init]
  Message to_home() const { return drives_.to_home(); }
  cia402::ArmingPhase phase() const { return drives_.phase(); }
  /// Frames that a cycle sends on a bus at most. [init]
  int cycle_frames(int bus) const;

 private:
  Status judge_identity();
  Status read_interfaces();
  Status judge_interface(std::string_view word);
  Status place_joints();
  Status judge_load();
  Node* drive_of(int bus, std::uint16_t id);
  bool is_ours(const Node* node, std::uint16_t id) const;
  void take_feedback(Node& node, const CanFrame& frame);
  void take_emergency(Node& node, const CanFrame& frame);
  void judge(Node& node);
  void count_feedback(Node& node);
  int asked_bus() const;
  void carry_request();
  void send_commands();
  void send_heartbeat();
  void send_release();
  bool stop_strays();
  static CanFrame unwatched_frame(std::uint8_t node);

  const CanSettings* can_ = nullptr;
  const cia402::Cia402Settings* drive_ = nullptr;
  CommandMode mode_ = CommandMode::kEffort;
  int period_us_ = 1, buses_ = 0;
  std::array<Name, kMaxBuses> interfaces_;
  PdoLayout layout_;
  Nodes nodes_;
  Outboxes out_;
  Message why_;
  SdoClient sdo_;
  Startup startup_{nodes_, out_, sdo_, interfaces_, why_};
  cia402::Drives drives_;
  cia402::DriveCommands commands_, sent_;

  bool connected_ = false;
  std::int64_t now_ns_ = 0;        // of this cycle
  std::int64_t sampled_ns_ = 0;    // begin of the cycle that sent the last SYNC
  std::int64_t heartbeat_ns_ = 0;  // of our last heartbeat
  int since_refresh_ = 0;          // cycles since the controlwords were sent
  cia402::ObjectRequest carried_;  // to a drive
  int stray_ = 0;                  // the joint whose drive was looked at last, from 0
  int releases_ = 0;               // release frames still to be sent, two for every joint
  int conflict_ = -1;              // identifier that another node sent
};

}  // namespace tactus::can
