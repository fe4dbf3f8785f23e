// A whole pipeline with a Hal of your own on Linux: the loader builds it from a file, the executive
// arms the drives and runs the cycles. The robot of this example is where it was commanded to be.
#include <tactus/fer.hpp>
// The robot's header comes first.
#include <tactus/pipeline.hpp>
#include <tactus/reference.hpp>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>
#include <thread>

using namespace tactus;

struct OwnHal final : Hal {
  RobotState state;
  OwnHal() { state.q << 0.0, -0.8, 0.0, -2.4, 0.0, 1.6, 0.8; }
  Capabilities capabilities() const override { return {true, false, false, 1000, 10000}; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& measured) override {
    state.stamp_ns = now.stamp_ns;
    measured = state;
    return Status::kOk;
  }
  Status write(const RobotCommand& command) override {
    const bool enabled = command.request != DriveRequest::kDisable;
    state.drives.fill({enabled ? DriveState::kEnabled : DriveState::kDisabled, true});
    if (command.request == DriveRequest::kFollow) state.q = command.value;
    return Status::kOk;
  }
  Status disconnect() override { return Status::kOk; }
} hal;
ChannelMemory<JointSpace> channel;
RoomyPipeline pipeline;
Executive executive(hal, pipeline);

Status cycle() {
  std::this_thread::sleep_for(std::chrono::microseconds(pipeline.robot.period_us));
  const std::chrono::nanoseconds now = std::chrono::steady_clock::now().time_since_epoch();
  const Status status = executive.cycle({now.count()});
  return status == Status::kArming ? executive.arm() : status;
}

int main(int, char** argv) {
  std::ifstream file(argv[1]);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  LoadError error;
  if (Loader({&channel}, hal.capabilities()).load(text, pipeline, error) != Status::kOk)
    return std::printf("%s:%s\n", argv[1], error.message().c_str());
  Status status = executive.start() == Status::kOk ? executive.arm() : Status::kNotStarted;
  while (status == Status::kArming) status = cycle();
  const JointSpace::Point goal = {hal.state.q + JointVector::Constant(0.3)};
  std::uint32_t id = 0;
  if (status == Status::kOk) status = ReferenceClient<JointSpace>(channel).send(goal, id).status;
  for (int i = 0; i < 150 && status == Status::kOk; ++i) status = cycle();
  std::printf("%s, q1 = %.3f rad\n", name(status), hal.state.q[0]);
  for (executive.halt(); executive.busy();) status = cycle();
  return executive.stop() == Status::kOk && hal.state.q == goal.q ? 0 : 1;
}
