// The whole kernel linked for a bare Cortex-M7 with no C library on the link line, so that any call
// to the heap, to exceptions or to an operating system is a link error. Not a program to run: a
// board adds start-up code and a Hal.
#include <cstddef>

#include "kernel/executive.hpp"
#include "kernel/guard/collision.hpp"
#include "kernel/loader.hpp"

// What the compiler itself may call. The loops must not be turned back into calls of themselves.
extern "C" {
[[gnu::optimize("no-tree-loop-distribute-patterns")]] void* memcpy(void* to, const void* from,
                                                                   std::size_t size) {
  for (std::size_t i = 0; i < size; ++i)
    static_cast<char*>(to)[i] = static_cast<const char*>(from)[i];
  return to;
}
[[gnu::optimize("no-tree-loop-distribute-patterns")]] void* memmove(void* to, const void* from,
                                                                    std::size_t size) {
  if (to <= from) return memcpy(to, from, size);
  for (std::size_t i = size; i > 0; --i)
    static_cast<char*>(to)[i - 1] = static_cast<const char*>(from)[i - 1];
  return to;
}
[[gnu::optimize("no-tree-loop-distribute-patterns")]] void* memset(void* to, int value,
                                                                   std::size_t size) {
  for (std::size_t i = 0; i < size; ++i) static_cast<char*>(to)[i] = static_cast<char>(value);
  return to;
}
[[gnu::optimize("no-tree-loop-distribute-patterns")]] int memcmp(const void* a, const void* b,
                                                                 std::size_t size) {
  const auto* left = static_cast<const unsigned char*>(a);
  const auto* right = static_cast<const unsigned char*>(b);
  for (std::size_t i = 0; i < size; ++i) {
    if (left[i] != right[i]) return left[i] < right[i] ? -1 : 1;
  }
  return 0;
}
[[gnu::optimize("no-tree-loop-distribute-patterns")]] std::size_t strlen(const char* text) {
  std::size_t size = 0;
  while (text[size] != '\0') ++size;
  return size;
}
[[noreturn]] void abort() {
  for (;;) {
  }
}
}

namespace {

using namespace tactus;

/// A robot that stands where it was put.
class StandingHal final : public Hal {
 public:
  Capabilities capabilities() const override { return {false, false, true, 100, 100000}; }
  Status start(CommandMode, RobotState& state) override { return read(state); }
  Status read(RobotState& state) override {
    for (int i = 0; i < kDof; ++i) {
      const JointLimit& joint = Robot::kLimits[static_cast<std::size_t>(i)];
      state.q[i] = 0.5 * (joint.q_min + joint.q_max);
    }
    return Status::kOk;
  }
  Status write(const RobotCommand&) override { return Status::kOk; }
  void stop() override {}
};

// A FER's: what counts for another robot is that it links.
constexpr const char* kText =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\nkp = 100\nkd "
    "= 10\n";

StandingHal hal;
ReferenceChannel<JointSpace> channel;
Waypoint<JointSpace> waypoints[kStores][32];
Pipeline pipeline;
Executive executive(hal, pipeline, nullptr);
Collision collision;

}  // namespace

int main() {
  for (std::size_t i = 0; i < kStores; ++i) {
    channel.stores[i].waypoints = waypoints[i];
    channel.stores[i].capacity = 32;
  }
  Loader loader({&channel}, hal.capabilities());
  LoadError error;
  Status status = loader.load(kText, pipeline, error);
  if (status == Status::kOk) status = executive.start();
  if (status == Status::kOk)
    status = collision.start(pipeline.collision, pipeline.guard.effective(),
                             pipeline.robot.tool_tip, pipeline.robot.period_s());
  for (int k = 0; k < 1000 && status == Status::kOk; ++k) {
    status = executive.cycle({std::int64_t{1000000} * k});
    RobotState state;
    if (status == Status::kOk) status = hal.read(state);
    if (status == Status::kOk) status = collision.check(state);
  }
  return static_cast<int>(status);
}
