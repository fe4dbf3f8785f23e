// The master and seven emulated drives that stand, in lock step and without sockets.
#pragma once

#include "tests/wcet/can/standing_drives.hpp"

namespace tactus::can {

struct CanBench {
  static constexpr std::int64_t kPeriod_ns = 1'000'000;

  CanSettings can;
  cia402::Cia402Settings drive;
  CanMaster master;
  StandingDrives drives;
  Arrived arrived;
  RobotCommand command;
  RobotState state;
  std::int64_t now_ns = 0;
  std::uint32_t cycles = 0;  ///< of can_cycle()

  /// CAN FD: one bus and packed commands; classic: three buses and plain ones. [init]
  bool load(bool fd) {
    can.interfaces = Value(fd ? "can0" : "can0 can1 can2");
    can.frames = fd ? Frames::kFd : Frames::kClassic;
    can.commands = fd ? Commands::kPacked : Commands::kPlain;
    constexpr double kMostOfRated = 25.0;
    const JointLimits limits;
    for (int j = 0; j < kDof; ++j) {
      if (!fd) can.bus[j] = 1 + 3 * j / kDof;
      drive.rated_torque[j] = limits.tau_max[j] / kMostOfRated;
    }
    drives.load(can, drive);
    return master.configure(can, drive, Tool{}, CommandMode::kEffort, 1000, 10000) == Status::kOk;
  }
  /// Takes what the drives have sent. [cyclic]
  void collect() {
    CanFrame frame;
    arrived.clear();
    for (std::size_t bus = 0; bus < static_cast<std::size_t>(master.buses()); ++bus)
      while (arrived.count[bus] < Arrived::kMost && drives.take(bus, frame))
        arrived.add(bus, frame);
  }
  /// Starts the drives up. [init]
  bool connect() {
    master.connect(0);
    for (int i = 0; i < 20000; ++i) {
      now_ns += kPeriod_ns / 4;
      drives.exchange(master, now_ns);
      collect();
      for (int bus = 0; bus < master.buses(); ++bus)
        for (int n = 0; n < arrived.count[static_cast<std::size_t>(bus)]; ++n)
          master.receive(bus,
                         arrived.frames[static_cast<std::size_t>(bus)][static_cast<std::size_t>(n)],
                         now_ns);
      const Status status = master.connecting(now_ns);
      if (status != Status::kArming) return status == Status::kOk;
    }
    return false;
  }
  /// One cycle with what has come. [cyclic]
  void cycle() {
    now_ns += kPeriod_ns;
    ++cycles;
    static_cast<void>(can_cycle(master, arrived, {now_ns}, command, state));
  }
  /// What the drives send, and nothing else.
  void quiet_cycle(DriveRequest request) {
    command.request = request;
    drives.exchange(master, now_ns);
    collect();
    cycle();
  }
};

}  // namespace tactus::can
