// Machine: the kernel on a board without an operating system: the objects of a pipeline and what
// the cycle and the messages do with them. A text that is to be run is loaded into a new Machine.
#pragma once

#include "gateway/reference_server.hpp"
#include "hal/serial/serial_hal.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "program/sim/sim_sections.hpp"

namespace bare {

/// Whole waypoints of a store; packed with positions only it holds almost four times as many. A
/// path is followed at full speed if the window of its store reaches beyond where the arm can stop:
/// with velocities and accelerations at 1 kHz, 384 whole ones are half a second.
inline constexpr int kJointWaypoints = 384, kPoses = 64;

template <class Space, int kWholeWaypoints>
struct References {
  explicit References(const tactus::PortTable& ports) : server(client, ports) {
    for (std::size_t i = 0; i < tactus::kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i];
      channel.stores[i].capacity = kWholeWaypoints;
    }
  }

  tactus::ChannelMemory<Space, 4, 32, 2> channel;
  tactus::Waypoint<Space> waypoints[tactus::kStores][kWholeWaypoints];
  tactus::ReferenceClient<Space> client{channel};
  tactus::ReferenceServer<Space> server;
};

class Machine {
 public:
  explicit Machine(tactus::serial::SerialHal& hal) : hal_(hal) {}

  /// Loads the pipeline; once. [init]
  tactus::Status load(std::string_view text, tactus::LoadError& error);
  /// Opens the wire. [init]
  tactus::Status start();
  /// Runs a cycle as the newest order says. [cyclic]
  void cycle(const tactus::CycleTime& now, tactus::serial::CycleResult& result);
  /// Disables the drives at once. [between two cycles]
  void stop() { static_cast<void>(executive_.stop()); }

  /// Whether the pipeline has a generator of that space. [background]
  bool takes(bool poses) const { return poses ? pipeline_.takes_poses : pipeline_.takes_joints; }
  /// Calls `act` with the references of a space that it takes. [background]
  template <class Act>
  auto with_references(bool poses, Act act) {
    return poses ? act(poses_.server) : act(joints_.server);
  }
  /// Fetches reports. [background]
  bool poll() { return joints_.server.poll() | poses_.server.poll(); }
  int reports() const { return joints_.server.waiting() + poses_.server.waiting(); }
  tactus::Report next_report();
  std::uint32_t period_us() const { return static_cast<std::uint32_t>(pipeline_.robot.period_us); }

 private:
  void follow(tactus::serial::Order order);

  tactus::serial::SerialHal& hal_;
  tactus::SimSections sections_;
  tactus::PipelineMemory<std::size_t{26} << 10> pipeline_;
  References<tactus::JointSpace, kJointWaypoints> joints_{pipeline_.ports};
  References<tactus::TaskSpace, kPoses> poses_{pipeline_.ports};
  tactus::Executive executive_{hal_, pipeline_};
  tactus::serial::Order order_ = tactus::serial::Order::kDisabled;
  std::uint32_t cycles_ = 0;
};

}  // namespace bare
