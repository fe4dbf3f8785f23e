// EthercatHal: seven CiA 402 drives on one EtherCAT segment. It carries the frames of
// EthercatMaster: in a cycle one system call takes the frame that has returned, and one sends the
// next.
//
// connect() brings the slaves to OP, checks and configures the drives and enables none. A drive's
// fault is a fault of its joint, and the drives can be armed again; read() fails only if the
// interface does not work any more, and from then on until the next connect().
//
// It is also the clock of the cycles: the host's, steered so that frames are sent in step with the
// reference clock of the segment.
#pragma once

#include "hal/cia402/drive_hal.hpp"
#include "hal/ethercat/ethercat_master.hpp"
#include "hal/ethercat/packet_socket.hpp"

namespace tactus::ethercat {

class EthercatHal final : public Hal, private Clock {
 public:
  /// Takes the settings of the pipeline file, which must outlive the use of the Hal. As
  /// EthercatMaster::configure(); trouble() has details. [init]
  Status configure(const EthercatSettings& ethercat, const cia402::Cia402Settings& drive,
                   const Tool& tool, CommandMode mode, int period_us, int arming_ms);

  Capabilities capabilities() const override { return cia402::capabilities_of_drives(); }
  /// Opens the interface and starts the slaves up, in all no longer than `connect_ms`. kNotOffered,
  /// kConnectionLost, kBusTimeout, kRefusedByRobot, kNotReferenced; trouble() has details. [init]
  Status connect(CommandMode mode) override;
  Status read(const CycleTime& now, RobotState& state) override;
  Status write(const RobotCommand& command) override;
  /// As in Hal; also waits until the drives confirm that they are disabled, at most for
  /// `stop_ms`; then takes the slaves to INIT. kBusTimeout: trouble() names the joints that did not
  /// confirm.
  Status disconnect() override;
  Clock* clock() override { return this; }
  Message unstated() override { return master_.unstated(); }
  Message trouble() override { return master_.trouble(); }
  Message code_text(std::uint32_t code) const override { return cia402::text_of_code(code); }

  const EthercatMaster& master() const { return master_; }
  /// System calls of all cycles since the interface was opened. [any]
  int system_calls() const { return socket_.system_calls(); }

 private:
  static constexpr int kMostFrames = 8;  // taken at once: one, and late ones

  Status wait(CycleTime& now) override;
  Status start_up();
  void receive();
  void send();
  Status judge_link();
  Status stop_drives(Message& left);

  const EthercatSettings* ethercat_ = nullptr;
  CommandMode mode_ = CommandMode::kEffort;
  EthercatMaster master_;
  PacketSocket socket_;
  Frame frame_;
  Status fault_ = Status::kNotStarted;  // of the wire
  std::int64_t now_ns_ = -1;            // of the last cycle; -1: there was none
  std::int64_t began_ns_ = 0;           // of the last start-up
  std::int64_t planned_ns_ = -1;        // beginning of the last cycle; -1: there was none
};

}  // namespace tactus::ethercat
