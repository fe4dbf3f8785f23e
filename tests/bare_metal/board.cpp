// The image of a board with a Cortex-M7 and no C library: the longest pipeline of its robot, loaded
// from the text of its file, with collision check and stores of 256 waypoints. A call to the heap,
// to exceptions or to an operating system is a link error. In an emulator it sends a trajectory
// that fills a store, runs until that has ended, and prints how it went.
#include "gateway/reference_client.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "program/sim/sim_sections.hpp"
#include "tests/wcet/m7/console.hpp"
#include "tests/wcet/pipeline_text.hpp"

namespace {

using namespace tactus;
using semihosting::print;

/// A robot that stays where it was put.
class StandingHal final : public Hal {
 public:
  JointVector q = JointVector::Zero();

  Capabilities capabilities() const override { return {true, true, true, 100, 100000, true}; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& state) override {
    state.stamp_ns = now.stamp_ns;
    state.drives.fill({DriveState::kEnabled, true});
    state.q = q;
    return Status::kOk;
  }
  Status write(const RobotCommand&) override { return Status::kOk; }
  Status disconnect() override { return Status::kOk; }
};

// A store is 70 whole waypoints of 264 bytes, which are 256 of 72 bytes with positions only.
constexpr int kWholeWaypoints = 70, kPositions = 256;

StandingHal hal;
ChannelMemory<TaskSpace, 4, 32, 2> channel;
ReferenceClient<TaskSpace> client(channel);
Waypoint<TaskSpace> waypoints[kStores][kWholeWaypoints];
PipelineMemory<13'200> pipeline;
Executive executive(hal, pipeline);
SimSections sections;
LoadError error;
std::int64_t now_ns = 0;

Status cycle() {
  now_ns += std::int64_t{1000} * pipeline.robot.period_us;
  return executive.cycle({now_ns});
}

Status arm() {
  TRY(executive.start());
  Status status = executive.arm();
  for (int i = 0; i < 100 && status == Status::kArming; ++i) {
    if (cycle() == Status::kArming) status = executive.arm();
  }
  return status;
}

/// Sends a trajectory that fills a store and stays at the present reference.
Verdict send(const Pose& here, std::uint32_t& id) {
  Trajectory<TaskSpace>& trajectory = *client.acquire(0);
  if (trajectory.capacity != kPositions) return {Status::kReferenceSize};
  trajectory.count = trajectory.capacity;
  Waypoint<TaskSpace> waypoint;
  waypoint.point.x = here;
  for (int i = 0; i < trajectory.count; ++i) {
    waypoint.time_s = 0.01 * (i + 1);
    trajectory.set(i, waypoint);
  }
  return client.send(trajectory, id);
}

/// Runs until the trajectory has ended; returns how.
Outcome follow(std::uint32_t id, std::uint32_t& cycles) {
  Report report;
  for (cycles = 0; cycles < 5000 && cycle() == Status::kOk; ++cycles) {
    while (client.poll(report))
      if (report.id == id && report.outcome != Outcome::kStarted) return report.outcome;
  }
  return Outcome::kAborted;
}

int say(const char* what, const char* why) {
  print(what);
  print(": ");
  print(why);
  print("\n");
  return 1;
}

}  // namespace

extern "C" int measure() {
  for (std::size_t i = 0; i < kStores; ++i) {
    channel.stores[i].waypoints = waypoints[i];
    channel.stores[i].capacity = kWholeWaypoints;
  }
  Loader loader({nullptr, &channel}, hal.capabilities(), sections);
  if (loader.load(pipeline_file(), pipeline, error) != Status::kOk)
    return say("refused", error.message().c_str());
  hal.q = sections.plant.initial_q;
  const Status status = arm();
  if (status != Status::kOk) return say("not armed", name(status));
  const PortEntry* const x_d = pipeline.ports.find("trg.x_d");
  std::uint32_t id = 0, cycles = 0;
  const Verdict verdict = send(*static_cast<const Pose*>(x_d->value), id);
  if (!verdict.ok()) return say("not sent", name(verdict.status));
  const Outcome outcome = follow(id, cycles);
  print(cycles);
  say(" cycles", name(outcome));
  print(pipeline.memory.left());
  say(" bytes", "left for blocks");
  return outcome == Outcome::kSucceeded ? 0 : 1;
}
