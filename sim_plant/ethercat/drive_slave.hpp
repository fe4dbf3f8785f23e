// DriveSlave: one emulated CiA 402 drive on an EtherCAT segment: the application behind the slave
// controller (AL states, mailbox, process data) and the axis of sim_plant/drives.
#pragma once

#include "sim_plant/drives/axis.hpp"
#include "sim_plant/drives/errors.hpp"
#include "sim_plant/drives/faults.hpp"
#include "sim_plant/ethercat/coe_server.hpp"
#include "sim_plant/ethercat/esc.hpp"

namespace tactus::segment {

struct SlaveSettings {
  std::uint8_t number = 1;  ///< in the serial number
  drives::AxisSettings axis;
  SmPlaces places;
  EscClock clock;
  bool lrw = true;
  std::int64_t store_ns = 0;  ///< until 1010h:1 is answered
  bool sync0 = false;         ///< it demands SYNC0, with the period of 60C2h
};

class DriveSlave {
 public:
  /// Longest time from the request of OP to the first outputs.
  static constexpr std::int64_t kOutputs_ns = 1'000'000'000;

  DriveSlave() : axis_(dictionary_), objects_(dictionary_), server_(objects_) {}
  DriveSlave(const DriveSlave&) = delete;
  DriveSlave& operator=(const DriveSlave&) = delete;

  /// Power comes on. [init]
  void power_on(const SlaveSettings& settings);

  /// Does what a frame has left to do. [cyclic]
  void serve(std::int64_t now_ns);
  /// Timers; `periods`: that the arm has moved, by which faults are counted. [cyclic]
  void advance(std::int64_t now_ns, std::int64_t periods);
  /// Begins a period of the plant. [cyclic]
  void begin_period(const drives::JointSample& sample, double period_s);
  /// Takes the joint's state into the inputs. [cyclic]
  void measure(const drives::JointSample& sample);
  /// Falls to SAFEOP, or to INIT from below, with an error. [any]
  void fall(std::uint16_t code);

  Esc& esc() { return esc_; }
  drives::Axis& axis() { return axis_; }
  drives::Faults& faults() { return faults_; }
  const drives::Dictionary& dictionary() const { return dictionary_; }
  ethercat::AlState state() const { return state_; }

 private:
  using AlState = ethercat::AlState;

  // al_states.cpp
  void request(std::uint16_t control, std::int64_t now_ns);
  std::uint16_t judge(AlState to) const;
  std::uint16_t judge_sync0() const;
  bool places_fit(std::size_t sm, std::uint16_t start, std::size_t length, bool written) const;
  void enter(AlState state);
  void refuse(std::uint16_t code);
  void leave_operation();
  // drive_slave.cpp
  void serve_mailbox(std::int64_t now_ns);
  void post_mailbox();
  void note_written(const CoeResult& result);
  void take_outputs();
  void apply_controlword();
  void show_state();
  void raise(std::uint16_t code);
  void clear(std::uint16_t code);
  void inject();

  SlaveSettings settings_;
  SiiImage image_;
  Esc esc_;
  drives::Dictionary dictionary_;
  drives::Axis axis_;
  drives::Errors errors_;
  drives::Faults faults_;
  CoeObjects objects_;
  CoeServer server_;
  ProcessData outputs_, inputs_;
  AlState state_ = AlState::kInit;
  bool error_ = false, awaits_outputs_ = false, has_outputs_ = false;
  std::int64_t requested_ns_ = 0, periods_ = 0;
  std::int64_t stored_ns_ = 0;  // when its parameters are stored; until then no mailbox is served
};

}  // namespace tactus::segment
