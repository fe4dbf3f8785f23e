// The same on a Cortex-M with FreeRTOS: the cycle is a task of the highest priority. The first part
// stands for FreeRTOS.h and for your robot's wire.
#include <tactus/fer.hpp>
// The robot's header comes first.
#include <tactus/pipeline.hpp>
#include <tactus/reference.hpp>

using namespace tactus;

extern "C" std::uint32_t xTaskGetTickCount();
extern "C" void vTaskDelay(std::uint32_t ticks);
extern "C" bool wire_exchange(const double* command, bool enable, double* q, double* dq);

struct WireHal final : Hal {
  RobotState state;
  Status wire = Status::kOk;
  Capabilities capabilities() const override { return {true, false, false, 1000, 10000}; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& measured) override {
    state.stamp_ns = now.stamp_ns;
    measured = state;
    return wire;
  }
  Status write(const RobotCommand& command) override {
    const bool enable = command.request != DriveRequest::kDisable;
    const bool follow = command.request == DriveRequest::kFollow;
    const double* const value = follow ? command.value.data() : nullptr;
    const bool valid = wire_exchange(value, enable, state.q.data(), state.dq.data());
    state.drives.fill({enable ? DriveState::kEnabled : DriveState::kDisabled, valid});
    return wire = valid ? Status::kOk : Status::kBusTimeout;
  }
  Status disconnect() override { return write({}); }
};

WireHal hal;
ChannelMemory<JointSpace, 4, 32, 2> channel;
PipelineMemory<12'000> pipeline;  // the generator takes most of it
Executive executive(hal, pipeline);
LoadError error;                              // for the debugger: why the file was refused
ReferenceClient<JointSpace> client(channel);  // another task, of lower priority, sends by it

constexpr char kFile[] =
    "[robot]\nname = fer\nperiod_us = 1000\nq_c = jrg.q_d\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n";

extern "C" void control_task(void*) {
  Loader loader({&channel}, hal.capabilities());
  if (loader.load(kFile, pipeline, error) != Status::kOk || executive.start() != Status::kOk)
    return;
  Status status = executive.arm();
  std::int64_t now_ns = 0;
  for (std::uint32_t before = xTaskGetTickCount(); status != Status::kHalted;) {
    vTaskDelay(1);  // a tick of 1 ms
    const std::uint32_t tick = xTaskGetTickCount();
    now_ns += std::int64_t{1'000'000} * (tick - before);
    before = tick;
    status = executive.cycle({now_ns});
    if (status == Status::kArming) status = executive.arm();
  }
}
