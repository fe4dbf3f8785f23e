// Measures the CAN part of a cycle with seven drives: the master alone, and the system calls of its
// sockets. Beside it, as a measure, the kernel's own cycle with a short pipeline; Debian has no
// CANopen master to compare with.
#include <benchmark/benchmark.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <memory>

#include "hal/can/can_socket.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "tests/wcet/can/can_bench.hpp"

namespace tactus::can {
namespace {

constexpr int kArming = 600, kRecorded = 50;  // cycles: until the drives follow; of a heartbeat

/// Drives that follow, and what their buses brought in kRecorded cycles, which is played again.
struct Following {
  CanBench bench;
  std::array<Arrived, kRecorded> arrived;
  bool ready = false;

  explicit Following(bool fd) {
    ready = bench.load(fd) && bench.connect();
    for (int i = 0; i < kArming && ready; ++i) bench.quiet_cycle(DriveRequest::kArm);
    for (Arrived& each : arrived) {
      bench.quiet_cycle(DriveRequest::kFollow);
      each = bench.arrived;
    }
    ready = ready && bench.master.phase() == cia402::ArmingPhase::kArmed;
  }
};

/// Frames in to frames out.
void can_master(benchmark::State& loop, bool fd) {
  const auto following = std::make_unique<Following>(fd);
  CanBench& bench = following->bench;
  std::size_t n = 0;
  for (auto _ : loop) {
    bench.now_ns += CanBench::kPeriod_ns;
    benchmark::DoNotOptimize(can_cycle(bench.master, following->arrived[n++ % kRecorded],
                                       {bench.now_ns}, bench.command, bench.state));
  }
  if (!following->ready || bench.master.phase() != cia402::ArmingPhase::kArmed)
    loop.SkipWithError("the drives do not follow");
}
void can_master_fd_one_bus(benchmark::State& loop) {
  can_master(loop, true);
}
void can_master_classic_three_buses(benchmark::State& loop) {
  can_master(loop, false);
}
BENCHMARK(can_master_fd_one_bus);
BENCHMARK(can_master_classic_three_buses);

/// The two ends of a bus.
struct Link {
  CanSocket master, drives;

  explicit Link(bool fd) {
    int ends[2] = {-1, -1};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) != 0) return;
    master.adopt(ends[0], fd);
    drives.adopt(ends[1], fd);
  }
};

/// The system calls of a cycle, one that receives and one that sends on every bus, with the frames
/// of real cycles. Only the master's end is timed.
void can_sockets(benchmark::State& loop, bool fd) {
  const auto following = std::make_unique<Following>(fd);
  CanBench& bench = following->bench;
  std::array<Link, 3> links{Link(fd), Link(fd), Link(fd)};
  std::array<CanFrame, CanSocket::kBatch> frames;
  const auto buses = static_cast<std::size_t>(bench.master.buses());
  std::size_t n = 0;
  for (auto _ : loop) {
    const Arrived& arrived = following->arrived[n++ % kRecorded];
    for (std::size_t bus = 0; bus < buses; ++bus)
      benchmark::DoNotOptimize(
          links[bus].drives.send(arrived.frames[bus].data(), arrived.count[bus]));
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t bus = 0; bus < buses; ++bus) {
      const Outbox& outbox = bench.master.outbox(static_cast<int>(bus));
      benchmark::DoNotOptimize(links[bus].master.receive(frames.data(), CanSocket::kBatch));
      benchmark::DoNotOptimize(links[bus].master.send(outbox.frames(), outbox.count()));
    }
    loop.SetIterationTime(
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    for (std::size_t bus = 0; bus < buses; ++bus)
      benchmark::DoNotOptimize(links[bus].drives.receive(frames.data(), CanSocket::kBatch));
  }
  if (!following->ready || links[0].master.health().lost) loop.SkipWithError("the link is lost");
}
void can_sockets_fd_one_bus(benchmark::State& loop) {
  can_sockets(loop, true);
}
void can_sockets_classic_three_buses(benchmark::State& loop) {
  can_sockets(loop, false);
}
BENCHMARK(can_sockets_fd_one_bus)->UseManualTime();
BENCHMARK(can_sockets_classic_three_buses)->UseManualTime();

/// A robot that stays where it is.
class StandingHal final : public Hal {
 public:
  Capabilities capabilities() const override { return {true, true, true, 100, 100000, true}; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& state) override {
    const JointLimits limits;
    state.stamp_ns = now.stamp_ns;
    state.drives.fill({DriveState::kEnabled, true});
    state.q = 0.5 * (limits.q_min + limits.q_max);
    return Status::kOk;
  }
  Status write(const RobotCommand&) override { return Status::kOk; }
  Status disconnect() override { return Status::kOk; }
};

/// Joint positions are held by a PD controller with gravity, without a robot's wire.
void kernel_cycle_joint_pd(benchmark::State& loop) {
  StandingHal hal;
  ChannelMemory<JointSpace> channel;
  Waypoint<JointSpace> waypoints[4];
  channel.stores[0].waypoints = waypoints;
  channel.stores[0].capacity = 4;
  const auto pipeline = std::make_unique<RoomyPipeline>();
  Executive executive(hal, *pipeline);
  LoadError error;
  Message text("[robot]\nname = ");
  text << Robot::kName
       << "\nperiod_us = 1000\ntau_c = pd.tau\n"
          "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
          "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
          "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n";
  for (const char* gain : {"\nkp =", "\nkd ="}) {
    text << gain;
    for (int j = 0; j < kDof; ++j) text << " 10";
  }
  Loader loader({&channel}, hal.capabilities());
  Status status = loader.load(text, *pipeline, error);
  if (status == Status::kOk) status = executive.start();
  std::int64_t now_ns = 0;
  const auto cycle = [&] { return executive.cycle({now_ns += CanBench::kPeriod_ns}); };
  for (int i = 0; i < kArming && status == Status::kOk && executive.arm() != Status::kOk; ++i)
    (void)cycle();
  for (auto _ : loop) status = cycle();
  if (status != Status::kOk) loop.SkipWithError(error.message().c_str());
}
BENCHMARK(kernel_cycle_joint_pd);

}  // namespace
}  // namespace tactus::can
