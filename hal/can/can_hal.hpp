// CanHal: seven CiA 402 drives on one to four CAN buses. It carries the frames of CanMaster: in a
// cycle one system call per bus takes what has arrived and one sends what the cycle leaves.
//
// connect() resets, checks and configures the drives and enables none. A drive's fault is a fault
// of its joint, and the drives can be armed again; read() fails only if a bus does not work any
// more (bus-off, interface down) or another node commands the drives, and from then on until the
// next connect().
#pragma once

#include "hal/can/can_master.hpp"
#include "hal/can/can_socket.hpp"
#include "hal/cia402/drive_hal.hpp"

namespace tactus::can {

class CanHal final : public Hal {
 public:
  /// Takes the settings of the pipeline file, which must outlive the use of the Hal. As
  /// CanMaster::configure(); trouble() has details. [init]
  Status configure(const CanSettings& can, const cia402::Cia402Settings& drive, const Tool& tool,
                   CommandMode mode, int period_us, int arming_ms);

  Capabilities capabilities() const override { return cia402::capabilities_of_drives(); }
  /// Opens the buses and starts the drives up, in all no longer than `connect_ms`. kNotOffered,
  /// kConnectionLost, kBusTimeout, kRefusedByRobot, kNotReferenced; trouble() has details. [init]
  Status connect(CommandMode mode) override;
  Status read(const CycleTime& now, RobotState& state) override;
  Status write(const RobotCommand& command) override;
  /// As in Hal; also waits until the drives confirm that they are disabled, at most for
  /// `stop_ms`: drives that do not keep their watch over this program. A bus that has failed does
  /// not end the exchange on the others. kBusTimeout: trouble() names the joints that did not
  /// confirm.
  Status disconnect() override;
  Message unstated() override { return master_.unstated(); }
  Message trouble() override { return master_.trouble(); }
  Message code_text(std::uint32_t code) const override { return cia402::text_of_code(code); }

  const CanMaster& master() const { return master_; }
  const LinkHealth& health(int bus) const {
    return sockets_[static_cast<std::size_t>(bus)].health();
  }
  /// System calls of all cycles since the buses were opened. [any]
  int system_calls() const;

 private:
  Status open();
  Status start_up();
  void receive(int bus, std::int64_t now_ns);
  Status judge_link(int bus);
  Status send();
  void exchange(std::int64_t& slept_ns);
  bool awaits(int joint) const;
  Status stop_drives(Message& left);

  const CanSettings* can_ = nullptr;
  CommandMode mode_ = CommandMode::kEffort;
  CanMaster master_;
  std::array<CanSocket, kMaxBuses> sockets_;
  std::array<CanFrame, CanSocket::kBatch> frames_;
  std::array<int, kMaxBuses> unsent_{};  // cycles in a row in which a bus did not take all frames
  Status fault_ = Status::kNotStarted;   // of the wire
  std::int64_t now_ns_ = -1;             // of the last cycle; -1: there was none
};

}  // namespace tactus::can
