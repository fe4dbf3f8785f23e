// The emulated drives without their arm: every joint stands, so that a bare core can run them.
#pragma once

#include "sim_plant/drives/drive_bus.hpp"
#include "tests/wcet/can/can_cycle.hpp"

namespace tactus::can {

class StandingDrives {
 public:
  /// Switches the drives on, of the joints and nodes that the settings say. [init]
  void load(const CanSettings& can, const cia402::Cia402Settings& drive) {
    for (int j = 0; j < kDof; ++j) {
      drives::NodeSettings node;
      node.node = static_cast<std::uint8_t>(can.node[j]);
      node.fd = can.frames == Frames::kFd;
      node.axis.rated_mNm = static_cast<std::uint32_t>(1000.0 * drive.rated_torque[j] + 0.5);
      drives::DriveBus& bus = buses_[static_cast<std::size_t>(can.bus[j] - 1.0)];
      drives::Node& drive_of_joint = nodes_[static_cast<std::size_t>(j)];
      drive_of_joint.load(node, bus.queue(), 0);
      bus.add(drive_of_joint);
      const JointLimits limits;
      samples_[static_cast<std::size_t>(j)].q = 0.5 * (limits.q_min[j] + limits.q_max[j]);
      drive_of_joint.measure(samples_[static_cast<std::size_t>(j)]);
    }
  }
  /// Takes what the master sends and lets the time go on. [cyclic]
  void exchange(CanMaster& master, std::int64_t now_ns) {
    for (std::size_t j = 0; j < kDof; ++j) nodes_[j].begin_period(samples_[j], 1e-3, now_ns);
    for (int bus = 0; bus < master.buses(); ++bus) {
      Outbox& outbox = master.outbox(bus);
      for (int i = 0; i < outbox.count(); ++i)
        give(static_cast<std::size_t>(bus), outbox.frames()[i], now_ns);
      outbox.clear();
    }
    for (drives::Node& node : nodes_) node.advance(now_ns);
  }
  /// Takes the next frame that a drive of a bus sends; false: there is none. [cyclic]
  bool take(std::size_t bus, CanFrame& frame) { return buses_[bus].queue().take(frame); }

 private:
  void give(std::size_t bus, const CanFrame& frame, std::int64_t now_ns) {
    for (std::size_t j = 0; j < kDof; ++j) {
      drives::Node& node = nodes_[j];
      bool here = false;
      for (const drives::Node* each : buses_[bus]) here = here || each == &node;
      if (!here) continue;
      if (frame.id == node.sync_id())
        node.receive_sync(frame, now_ns, samples_[j]);
      else
        node.receive(frame, now_ns);
    }
  }

  std::array<drives::Node, kDof> nodes_;
  std::array<drives::JointSample, kDof> samples_{};
  std::array<drives::DriveBus, 3> buses_;
};

}  // namespace tactus::can
