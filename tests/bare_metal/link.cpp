// Links the whole kernel for a bare Cortex-M7 with no C library on the link line: a call to the
// heap, to exceptions or to an operating system is a link error. The result is not a program to
// run; a board adds start-up code and a Hal.
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"

namespace {

using namespace tactus;

/// A robot that stays where it was put.
class StandingHal final : public Hal {
 public:
  Capabilities capabilities() const override { return {false, false, true, 100, 100000}; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& state) override {
    state.stamp_ns = now.stamp_ns;
    state.drives.fill({DriveState::kEnabled, true});
    for (int i = 0; i < kDof; ++i) {
      const JointLimit& joint = Robot::kLimits[static_cast<std::size_t>(i)];
      state.q[i] = 0.5 * (joint.q_min + joint.q_max);
    }
    return Status::kOk;
  }
  Status write(const RobotCommand&) override { return Status::kOk; }
  void disconnect() override {}
};

// A pipeline of the FER; for another robot only linking matters.
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
  if (status == Status::kOk) status = executive.arm();
  for (int k = 0; k < 1000 && (status == Status::kOk || status == Status::kArming); ++k) {
    status = executive.cycle({std::int64_t{1000000} * k});
    if (status == Status::kArming) status = executive.arm();
  }
  return static_cast<int>(status);
}
