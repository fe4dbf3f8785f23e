// Node: one emulated drive on a bus: a CANopen device (CiA 301) with the axis of CiA 402. Frames
// in, frames out into a queue; time is passed in.
#pragma once

#include "sim_plant/drives/axis.hpp"
#include "sim_plant/drives/errors.hpp"
#include "sim_plant/drives/faults.hpp"
#include "sim_plant/drives/frame_queue.hpp"
#include "sim_plant/drives/pdo.hpp"
#include "sim_plant/drives/sdo_server.hpp"

namespace tactus::drives {

struct NodeSettings {
  std::uint8_t node = 1;
  bool fd = false;  ///< TPDOs are frames of CAN FD, up to 64 bytes
  AxisSettings axis;
  std::int64_t boot_ns = 10'000'000;  ///< from power-on or reset to the boot-up message
  std::int64_t store_ns = 0;          ///< until 1010h:1 is answered
  bool starts = false;                ///< by itself: operational after boot-up (CiA 302-2)
};

class Node {
 public:
  Node() : axis_(dictionary_) {}
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  /// Power comes on at `now_ns`. The queue must outlive the node. [init]
  void load(const NodeSettings& settings, FrameQueue& queue, std::int64_t now_ns);

  /// Takes a frame of the bus that is not SYNC. [cyclic]
  void receive(const can::CanFrame& frame, std::int64_t now_ns);
  /// Takes a frame with the identifier of SYNC, after the plant has moved: applies the commands
  /// that came before it, samples `sample` and sends. [cyclic]
  void receive_sync(const can::CanFrame& frame, std::int64_t now_ns, const JointSample& sample);
  /// Timers. [cyclic]
  void advance(std::int64_t now_ns);

  /// Begins a period of the plant. [cyclic]
  void begin_period(const JointSample& sample, double period_s, std::int64_t now_ns);
  /// Notes what the joint does now, for objects that are read between SYNCs. [cyclic]
  void measure(const JointSample& sample);

  Axis& axis() { return axis_; }
  const Axis& axis() const { return axis_; }
  Faults& faults() { return faults_; }
  const Dictionary& dictionary() const { return dictionary_; }
  can::NmtState nmt() const { return device_.nmt; }
  int number() const { return settings_.node; }
  bool operational() const { return device_.nmt == can::NmtState::kOperational; }
  std::uint16_t sync_id() const;

 private:
  struct Watched {
    std::int64_t deadline_ns = 0;  // 0: no heartbeat has come yet
    bool lost = false;
  };

  void reset(can::NmtCommand command, std::int64_t now_ns);
  void take_nmt(const can::CanFrame& frame, std::int64_t now_ns);
  void enter(can::NmtState state, std::int64_t now_ns);
  void take_sdo(const can::CanFrame& frame, std::int64_t now_ns);
  void note_written(std::uint16_t index, std::uint8_t sub, std::int64_t now_ns);
  void apply_controlword();
  void show_state();
  void send_heartbeat(std::int64_t now_ns);
  void answer_remote(std::uint16_t id, std::int64_t now_ns);
  void raise(std::uint16_t code, bool faults);
  void clear(std::uint16_t code);
  void send(const can::Emergency& emergency);
  void lose_master();
  void take_heartbeat(const can::CanFrame& frame, std::int64_t now_ns);
  void watch_anew(std::uint8_t entry);
  void find_heartbeat_again(Watched& watched);
  void watch(std::int64_t now_ns);
  void inject(std::int64_t now_ns);

  // node_pdo.cpp: reception and sending of PDOs
  void load_pdos();
  void load_pdo(std::uint16_t index);
  void begin_operation(std::int64_t now_ns);
  bool take_rpdo(const can::CanFrame& frame, std::int64_t now_ns);
  void apply(const PdoSettings& pdo, const std::array<std::uint8_t, can::kMaxData>& data);
  void send_on_sync(const can::CanFrame& frame, std::int64_t now_ns);
  void send_events(std::int64_t now_ns);
  void send_tpdo(Tpdo& tpdo, std::int64_t now_ns);
  void push_tpdo(Tpdo& tpdo, can::CanFrame frame);

  NodeSettings settings_;
  FrameQueue* queue_ = nullptr;
  Dictionary dictionary_;
  DeviceState device_;
  SdoServer sdo_;
  Errors errors_;
  Axis axis_;
  Faults faults_;
  std::array<Rpdo, kPdos> rpdos_{};
  std::array<Tpdo, kPdos> tpdos_{};
  std::array<Watched, kHeartbeatsWatched> watched_{};
  std::int64_t syncs_ = 0;  // received since power-on
  std::int64_t boot_ns_ = 0, heartbeat_ns_ = 0, sync_deadline_ns_ = 0;
  bool guard_toggle_ = false;
  can::CanFrame stored_;                     // the answer to 1010h:1
  std::int64_t stored_ns_ = 0;               // when it is sent; 0: it does not store
  std::array<can::CanFrame, kPdos> held_{};  // TPDOs that a fault delays
  std::array<bool, kPdos> holds_{};
};

}  // namespace tactus::drives
