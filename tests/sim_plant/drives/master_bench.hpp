// The whole loop of the FER on CAN without sockets and without a clock: executive, pipeline and
// master here, the emulated drives and their arm there, and between them a wire that a test can
// disturb and that watches what is commanded.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "hal/can/can_master.hpp"
#include "sim_plant/drives/drive_arm.hpp"
#include "tests/hal/cia402/loop_bench.hpp"

namespace tactus::can {

/// What a disturbed wire does to one frame on its way.
enum class Wire : std::uint8_t { kCarries, kLoses, kDoubles, kDelays, kCuts, kRewords };

struct Disturbance {
  Wire wire = Wire::kCarries;
  bool to_drive = false;     ///< of commands, not of feedback
  std::uint16_t id = 0;      ///< of the frames
  int first = 0, last = -1;  ///< cycles after the first command, both included
  std::uint16_t word = 0;    ///< kRewords: the first two bytes

  bool concerns(bool down, const CanFrame& frame, int cycle) const {
    return down == to_drive && frame.id == id && cycle >= first && cycle <= last;
  }
};

/// The master between the executive and the emulated drives.
class WiredHal final : public Hal {
 public:
  CanMaster master;
  drives::DriveArm arm;
  std::int64_t period_ns = 1'000'000;
  Disturbance disturbance;
  bool down = false;              ///< the interface
  int cycle = 0;                  ///< of the exchange
  std::vector<CanFrame> strange;  ///< frames of somebody else, which come with the next cycle
  std::vector<CanFrame> sent;     ///< in this cycle
  std::vector<CanFrame> log;      ///< of all frames, if `logs`
  bool logs = false;

  Capabilities capabilities() const override { return cia402::capabilities_of_drives(); }
  Status connect(CommandMode) override {
    constexpr std::int64_t kStep_ns = 100'000, kMost_ns = 20'000'000'000;
    static_cast<void>(disconnect());
    const std::int64_t began_ns = time_ns_;
    master.connect(0);
    Status status = Status::kArming;
    while (status == Status::kArming && time_ns_ - began_ns < kMost_ns) {
      time_ns_ += kStep_ns;
      exchange(time_ns_ - began_ns);
      status = master.connecting(time_ns_ - began_ns);
    }
    deliver();
    begin_ns_ = time_ns_ += period_ns;
    cycle = 0;
    fault_ = down ? Status::kConnectionLost : status;
    return fault_;
  }
  Status read(const CycleTime& now, RobotState& state) override {
    time_ns_ = begin_ns_ + now.stamp_ns;
    if (fault_ == Status::kOk && down) fault_ = Status::kConnectionLost;
    collect(now.stamp_ns);
    const Status status = master.read(now, state);
    if (fault_ == Status::kOk) fault_ = status;
    return fault_;
  }
  /// As CanHal: without a wire that works, the drives are still told to stop.
  Status write(const RobotCommand& command) override {
    RobotCommand to_send = command;
    if (fault_ != Status::kOk) to_send.request = DriveRequest::kDisable;
    master.write(to_send);
    deliver();
    ++cycle;
    return fault_;
  }
  Status disconnect() override {
    master.leave();
    deliver();
    fault_ = Status::kNotStarted;
    return Status::kOk;
  }
  Message trouble() override { return master.trouble(); }

  /// The targets of joint `j` in the commands of this cycle; 0 if there were none. [any]
  std::int16_t torque_sent(int j) const {
    for (const CanFrame& frame : sent) {
      if (frame.size == 32 && frame.id == kRpdoBase[0] + 1)
        return can::load<std::int16_t>(frame.data, static_cast<std::size_t>(4 * j + 2));
      if (frame.size == 4 && frame.id == kRpdoBase[0] + j + 1)
        return can::load<std::int16_t>(frame.data, 2);
    }
    return 0;
  }

 private:
  void exchange(std::int64_t now_ns) {
    deliver();
    collect(now_ns);
  }
  /// Master to drives.
  void deliver() {
    sent.clear();
    for (int bus = 0; bus < master.buses(); ++bus) {
      Outbox& outbox = master.outbox(bus);
      std::vector<CanFrame> frames(outbox.frames(), outbox.frames() + outbox.count());
      outbox.clear();
      for (const CanFrame& frame : frames) {
        sent.push_back(frame);
        if (down) continue;
        carry(frame, true, held_down_,
              [&](const CanFrame& f) { arm.receive(static_cast<std::size_t>(bus), f, time_ns_); });
      }
    }
    arm.advance(time_ns_);
  }
  /// Drives to master.
  void collect(std::int64_t now_ns) {
    arm.advance(time_ns_);
    for (const CanFrame& frame : strange) {
      master.receive(0, frame, now_ns);
      for (std::size_t bus = 0; bus < static_cast<std::size_t>(master.buses()); ++bus)
        arm.receive(bus, frame, time_ns_);
    }
    strange.clear();
    for (int bus = 0; bus < master.buses(); ++bus) {
      const std::vector<CanFrame> late = std::move(held_up_[static_cast<std::size_t>(bus)]);
      held_up_[static_cast<std::size_t>(bus)].clear();
      for (const CanFrame& frame : late) master.receive(bus, frame, now_ns);
      CanFrame frame;
      while (arm.take(static_cast<std::size_t>(bus), frame))
        if (!down)
          carry(frame, false, held_up_[static_cast<std::size_t>(bus)],
                [&](const CanFrame& f) { master.receive(bus, f, now_ns); });
    }
  }
  template <class Give>
  void carry(const CanFrame& frame, bool to_drive, std::vector<CanFrame>& held, Give give) {
    if (logs) log.push_back(frame);
    CanFrame cut = frame;
    switch (disturbance.concerns(to_drive, frame, cycle) ? disturbance.wire : Wire::kCarries) {
      case Wire::kLoses: return;
      case Wire::kDelays: held.push_back(frame); return;
      case Wire::kDoubles: give(frame); break;
      case Wire::kCuts: cut.size = static_cast<std::uint8_t>(frame.size / 2); break;
      case Wire::kRewords: can::store(cut.data, 0, disturbance.word); break;
      case Wire::kCarries: break;
    }
    give(cut);
  }

  std::int64_t time_ns_ = 0, begin_ns_ = 0;
  Status fault_ = Status::kNotStarted;  // of the wire, until the next connect()
  std::vector<CanFrame> held_down_;
  std::array<std::vector<CanFrame>, kMaxBuses> held_up_;
};

struct MasterBench : cia402::LoopBench<WiredHal> {
  CanSettings can;
  drives::DriveArmSettings plant;

  /// The seven drives on one CAN FD bus, unless the settings are changed before load().
  MasterBench() {
    can.interfaces = Value("vcan0");
    can.frames = Frames::kFd;
    can.commands = Commands::kPacked;
    plant.plant.rotor_inertia.setConstant(0.1);
  }
  /// Builds drives and arm, and loads the pipeline.
  Status load(const char* text = cia402::kHoldingPipeline) {
    TRY(LoopRig::load(text, hal.capabilities()));
    TRY(hal.master.configure(can, drive, pipeline.robot.tool.value, pipeline.robot.mode(),
                             pipeline.robot.period_us, pipeline.executive.arming_ms));
    plant.fd = can.frames == Frames::kFd;
    for (int j = 0; j < kDof; ++j)
      plant.joints[static_cast<std::size_t>(j)] = {static_cast<int>(can.bus[j]) - 1,
                                                   static_cast<int>(can.node[j])};
    hal.period_ns = period_ns();
    return hal.arm.load(plant, 0);
  }
  JointVector plant_q() { return hal.arm.arm().q(); }
  JointVector plant_dq() { return hal.arm.arm().dq(); }
};

}  // namespace tactus::can
