// The whole loop of the FER on EtherCAT without sockets and without a clock: executive, pipeline
// and master here, the emulated segment and its arm there.
#pragma once

#include <string>

#include "gateway/reference_client.hpp"
#include "hal/ethercat/ethercat_master.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "sim_plant/ethercat/segment.hpp"
#include "tests/support/testing.hpp"

namespace tactus::ethercat {

/// The master between the executive and the emulated segment.
class WiredHal final : public Hal {
 public:
  EthercatMaster master;
  segment::Segment line;
  std::int64_t period_ns = 1'000'000;
  int exchanges = 0;   ///< frames of the start-up and of the cycles
  int lose_every = 0;  ///< frames of the start-up do not come back: each so many
  Frame sent;          ///< the last one

  Capabilities capabilities() const override {
    Capabilities offered;
    offered.position = offered.velocity = offered.effort = true;
    offered.velocity_feed_forward = offered.effort_feed_forward = true;
    offered.min_period_us = 500;
    offered.max_period_us = 20000;
    return offered;
  }
  Status connect(CommandMode) override {
    constexpr std::int64_t kStep_ns = 50'000, kMost_ns = 60'000'000'000;
    static_cast<void>(disconnect());
    const std::uint8_t source[6] = {0x02, 0, 0, 0, 0, 0x01};
    const std::int64_t began_ns = time_ns_;
    master.connect(source, 0);
    Status status = Status::kArming;
    while (status == Status::kArming && time_ns_ - began_ns < kMost_ns) {
      time_ns_ += kStep_ns;
      collect();
      status = master.connecting(time_ns_ - began_ns);
      deliver();
    }
    begin_ns_ = time_ns_ += period_ns;
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

 private:
  void deliver() {
    Frame frame;
    while (master.take(frame)) {
      sent = frame;
      line.receive(frame, time_ns_);
      ++exchanges;
    }
    line.advance(time_ns_);
  }
  void collect() {
    line.advance(time_ns_);
    Frame frame;
    while (line.take(frame))
      if (lose_every == 0 || exchanges % lose_every != 0) master.receive(frame);
  }

  std::int64_t time_ns_ = 0, begin_ns_ = 0;
  Status fault_ = Status::kNotStarted;
};

inline constexpr const char* kHoldingPipeline =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n";

struct MasterBench {
  EthercatSettings ethercat;
  cia402::Cia402Settings drive;
  segment::SegmentSettings plant;
  WiredHal hal;
  ChannelMemory<JointSpace> channel;
  std::array<Waypoint<JointSpace>, 16> waypoints;
  ReferenceClient<JointSpace> client{channel};
  RoomyPipeline pipeline;
  Executive executive{hal, pipeline};
  std::int64_t now_ns = -1'000'000;

  MasterBench() {
    ethercat.interface = Value("eth0");
    ethercat.clock_frames = 100;
    drive.rated_torque << 3.0, 3.0, 3.0, 3.0, 0.5, 0.5, 0.5;
    plant.plant.rotor_inertia.setConstant(0.1);
  }
  /// Builds segment and arm, and loads the pipeline.
  Status load(const char* text = kHoldingPipeline) {
    channel.stores[0].waypoints = waypoints.data();
    channel.stores[0].capacity = static_cast<int>(waypoints.size());
    Loader loader({&channel}, hal.capabilities());
    LoadError error;
    const Status status = loader.load(text, pipeline, error);
    if (status != Status::kOk) print_error("%s\n", error.message().c_str());
    TRY(status);
    TRY(hal.master.configure(ethercat, drive, Tool{}, pipeline.robot.mode(),
                             pipeline.robot.period_us));
    hal.period_ns = std::int64_t{1000} * pipeline.robot.period_us;
    return hal.line.load(plant, 0);
  }
  Status cycle() { return executive.cycle({now_ns += hal.period_ns}); }
  Status cycles(int count) {
    Status status = Status::kOk;
    for (int i = 0; i < count && status == Status::kOk; ++i) status = cycle();
    return status;
  }
  /// Asks for the drives and runs cycles until they are taken over or refused.
  Status arm() {
    Status status = executive.arm();
    while (status == Status::kArming) {
      status = cycle();
      if (status == Status::kArming) status = executive.arm();
    }
    return status;
  }
  Status start() {
    TRY(executive.start());
    now_ns = -hal.period_ns;
    return arm();
  }
  /// Cycles until the drives are disabled, or at most `most`; returns their number.
  int settle(int most = 3000) {
    int count = 0;
    while (count < most && executive.busy()) {
      (void)cycle();
      ++count;
    }
    return count;
  }
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

}  // namespace tactus::ethercat
