// Segment: emulated drives in a line, through which frames pass, and what can go wrong on the line.
// Frames in, frames out; time is passed in, so that it runs without sockets and repeatably.
//
// A frame passes the slaves in their order and comes back to the sender with what they made of it.
// One that carries outputs moves the arm first by one period of 60C2h with the commands in force,
// so that its inputs are the newest samples and its outputs act in the next period. Without such
// frames for 20 ms the arm follows the clock, so that brakes close and stops end.
#pragma once

#include "kernel/core/status.hpp"
#include "sim_plant/drives/driven_arm.hpp"
#include "sim_plant/ethercat/drive_slave.hpp"
#include "sim_plant/ethercat/line_faults.hpp"

namespace tactus::segment {

struct SegmentSettings : drives::DrivenArmSettings {
  int slaves = kDof;
  std::array<SmPlaces, kDof> places;  ///< of each slave
  std::array<bool, kDof> no_lrw{};    ///< slaves that do not have LRW
  std::array<bool, kDof> sync0{};     ///< slaves that demand SYNC0
  std::int64_t drift_ppb = 20'000;    ///< of the clocks, alternately faster and slower
  std::uint64_t seed = 1;             ///< of faults by probability
};

class Segment {
 public:
  static constexpr std::int64_t kHop_ns = 500;  ///< from slave to slave

  /// Power comes on. kBadValue if a setting is outside its range. Allocates the arm's memory.
  /// [init]
  Status load(const SegmentSettings& settings, std::int64_t now_ns);
  /// Adds a fault of a drive, by its number as node, or of the line. False: no room. [init]
  bool add(const drives::Fault& fault);
  bool add(const LineFault& fault) { return line_.add(fault); }

  /// Ends all faults. [any]
  void clear_faults() {
    line_.clear();
    for (DriveSlave& slave : slaves_) slave.faults().clear();
  }

  /// Takes a frame; what is no EtherCAT frame is dropped. Times must not decrease. [cyclic]
  void receive(const ethercat::Frame& frame, std::int64_t now_ns);
  /// Copies a frame that has come back; false: there is none. [cyclic]
  bool take(ethercat::Frame& frame);
  /// Timers, and the arm when there are no frames; every millisecond or so. [cyclic]
  void advance(std::int64_t now_ns);

  DriveSlave& slave(int i) { return slaves_[static_cast<std::size_t>(i)]; }
  int slaves() const { return settings_.slaves; }
  drives::DrivenArm& arm() { return driven_; }
  std::int64_t malformed() const { return malformed_; }  ///< frames that were not whole

 private:
  static constexpr std::int64_t kNoFrames_ns = 20'000'000;
  static constexpr int kMostAtOnce = 200;  // periods that are caught up without frames
  static constexpr std::size_t kQueue = 4;

  void pass(ethercat::Frame& frame, int reached, std::int64_t now_ns);
  bool carries_outputs(ethercat::Frame& frame) const;
  void move();
  void send_back(const ethercat::Frame& frame);

  SegmentSettings settings_;
  drives::DrivenArm driven_;
  std::array<DriveSlave, kDof> slaves_;
  LineFaults line_;
  std::array<ethercat::Frame, kQueue> back_;
  std::size_t first_ = 0, count_ = 0;
  ethercat::Frame held_;
  bool holds_ = false;
  int last_reached_ = 0;
  std::int64_t plant_ns_ = 0, frame_ns_ = 0, malformed_ = 0;
};

}  // namespace tactus::segment
