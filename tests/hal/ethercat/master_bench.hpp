// The whole loop of the FER on EtherCAT without sockets and without a clock: executive, pipeline
// and master here, the emulated segment and its arm there.
#pragma once

#include <functional>
#include <string>

#include "hal/ethercat/ethercat_master.hpp"
#include "sim_plant/ethercat/segment.hpp"
#include "tests/hal/cia402/loop_bench.hpp"

namespace tactus::ethercat {

/// The master between the executive and the emulated segment.
class WiredHal final : public Hal {
 public:
  EthercatMaster master;
  segment::Segment line;
  std::int64_t period_ns = 1'000'000;
  int exchanges = 0;                   ///< frames of the start-up and of the cycles
  int give_up_after = 1 << 30;         ///< exchanges of a start-up
  int silent_after = 1 << 30;          ///< exchanges after which no frame comes back
  int lose_every = 0;                  ///< frames of the start-up do not come back: each so many
  Frame sent;                          ///< the last one
  std::function<void(Frame&)> tamper;  ///< with frames that come back
  std::function<void(Frame&)> change;  ///< those that are sent

  Capabilities capabilities() const override { return cia402::capabilities_of_drives(); }
  Status connect(CommandMode) override {
    constexpr std::int64_t kStep_ns = 50'000, kMost_ns = 60'000'000'000;
    static_cast<void>(disconnect());
    const std::uint8_t source[6] = {0x02, 0, 0, 0, 0, 0x01};
    const std::int64_t began_ns = time_ns_;
    master.connect(source, 0);
    Status status = Status::kArming;
    while (status == Status::kArming && time_ns_ - began_ns < kMost_ns &&
           exchanges < give_up_after) {
      time_ns_ += kStep_ns;
      collect();
      status = master.connecting(time_ns_ - began_ns);
      deliver();
    }
    begin_ns_ = time_ns_ = began_ns + master.in_step(time_ns_ + period_ns - began_ns);
    return fault_ = status;
  }
  Status read(const CycleTime& now, RobotState& state) override {
    time_ns_ = begin_ns_ + now.stamp_ns;
    collect();
    const Status status = master.read(now, state);
    return fault_ == Status::kOk ? status : fault_;
  }
  Status write(const RobotCommand& command) override {
    master.write(command);
    deliver();
    return fault_;
  }
  Status disconnect() override {
    master.leave();
    deliver();
    fault_ = Status::kNotStarted;
    return Status::kOk;
  }
  Message trouble() override { return master.trouble(); }
  std::int64_t time_ns() const { return time_ns_; }  ///< of the segment

 private:
  void deliver() {
    Frame frame;
    while (master.take(frame)) {
      sent = frame;
      if (change) change(frame);
      line.receive(frame, time_ns_);
      ++exchanges;
    }
    line.advance(time_ns_);
  }
  void collect() {
    line.advance(time_ns_);
    Frame frame;
    while (line.take(frame)) {
      if (tamper) tamper(frame);
      if (exchanges >= silent_after) continue;
      if (lose_every == 0 || exchanges % lose_every != 0) master.receive(frame);
    }
  }

  std::int64_t time_ns_ = 0, begin_ns_ = 0;
  Status fault_ = Status::kNotStarted;
};

struct MasterBench : cia402::LoopBench<WiredHal> {
  EthercatSettings ethercat;
  segment::SegmentSettings plant;

  MasterBench() {
    ethercat.interface = Value("eth0");
    ethercat.clock_frames = 100;
    plant.plant.rotor_inertia.setConstant(0.1);
  }
  /// Builds segment and arm, and loads the pipeline.
  Status load(const char* text = cia402::kHoldingPipeline) {
    TRY(LoopRig::load(text, hal.capabilities()));
    TRY(hal.master.configure(ethercat, drive, pipeline.robot.tool.value, pipeline.robot.mode(),
                             pipeline.robot.period_us, pipeline.executive.arming_ms));
    hal.period_ns = period_ns();
    return hal.line.load(plant, 0);
  }
  JointVector plant_q() { return hal.line.arm().arm().q(); }
  JointVector plant_dq() { return hal.line.arm().arm().dq(); }
  void add(segment::LineFaultKind kind, int slave, std::int64_t from, std::int64_t cycles,
           int value = 0) {
    segment::LineFault fault;
    fault.kind = kind;
    fault.slave = slave;
    fault.at = hal.line.arm().periods() + from;
    fault.until = fault.at + cycles;
    fault.value = static_cast<std::uint16_t>(value);
    assert_true(hal.line.add(fault));
  }
  void add(drives::FaultKind kind, int node, std::uint32_t value = 0) {
    drives::Fault fault;
    fault.node = node;
    fault.kind = kind;
    fault.value = value;
    assert_true(hal.line.add(fault));
  }
};

/// A bench of its own for a run; the last one is deleted, so that a failed test leaves nothing.
inline MasterBench& fresh_bench() {
  static MasterBench* bench = nullptr;
  delete bench;
  return *(bench = new MasterBench);
}

}  // namespace tactus::ethercat
