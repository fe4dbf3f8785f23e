// DriveArm: the robot of this build as drives on one or several CAN buses, with the arm that they
// move. Frames in, frames out; time is passed in, so that it runs without sockets and repeatably.
//
// The first SYNC of a new cycle, on whichever bus, moves the arm by one period of 60C2h with the
// commands in force; then each drive takes the commands that came before the SYNC of its own bus,
// samples and answers. A bus that is late or silent therefore delays no other. Without any SYNC for
// 20 ms the arm follows the clock, so that brakes close and stops end when the master is gone.
#pragma once

#include <array>

#include "kernel/core/status.hpp"
#include "sim_plant/drives/drive_bus.hpp"
#include "sim_plant/drives/driven_arm.hpp"

namespace tactus::drives {

inline constexpr std::size_t kBuses = kDof;

struct DriveArmSettings : DrivenArmSettings {
  struct Place {
    int bus = 0, node = 0;  ///< node 0: the joint has no drive, and its brake is closed
  };
  std::array<Place, kDof> joints{};
  bool fd = false;
  std::int64_t boot_ns = 10'000'000;
  bool start = false;      ///< the drives start by themselves (CiA 302-2)
  std::uint64_t seed = 1;  ///< of faults by probability
};

class DriveArm {
 public:
  /// Builds the arm with its brakes closed; the drives boot. kBadValue if a setting is outside its
  /// range. Allocates the arm's memory. [init]
  Status load(const DriveArmSettings& settings, std::int64_t now_ns);

  /// Adds a fault to its node. False: there is no room. [init]
  bool add(const Fault& fault);

  /// Takes a frame of a bus. Times must not decrease. [cyclic]
  void receive(std::size_t bus, const can::CanFrame& frame, std::int64_t now_ns);
  /// Timers, and the arm when there is no SYNC; every millisecond or so. [cyclic]
  void advance(std::int64_t now_ns);
  /// Takes the next frame that a drive sends; false: there is none. [cyclic]
  bool take(std::size_t bus, can::CanFrame& frame) { return buses_[bus].queue().take(frame); }

  Arm& arm() { return driven_.arm(); }
  Node& node(int joint) { return nodes_[static_cast<std::size_t>(joint)]; }
  std::int64_t periods() const { return driven_.periods(); }  ///< that the arm has moved

 private:
  static constexpr std::int64_t kNoSync_ns = 20'000'000;
  static constexpr int kMostAtOnce = 200;  // periods that are caught up without SYNC

  void receive_sync(std::size_t bus, const can::CanFrame& frame, std::int64_t now_ns);
  void move(std::int64_t now_ns);
  bool has_drive(int joint) const;
  void measure();
  double period_s() const;

  DriveArmSettings settings_;
  DrivenArm driven_;
  std::array<Node, kDof> nodes_;
  std::array<DriveBus, kBuses> buses_;
  std::array<bool, kBuses> synced_{};  // had its SYNC in this cycle
  std::int64_t plant_ns_ = 0, sync_ns_ = 0;
};

}  // namespace tactus::drives
