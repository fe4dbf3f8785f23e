// The whole loop in one object: pipeline, executive, generator and simulated robot, for tests of
// the physics.
#pragma once

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "gateway/gateway_section.hpp"
#include "gateway/reference_client.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "sim_plant/arm/sim_hal.hpp"
#include "tests/support/armed.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

/// The gains of PD with gravity compensation in the robot's own pipeline: the lines of kp, N m/rad,
/// and kd, N m s/rad.
inline std::string pd_gains() {
  char path[64], line[256];
  std::snprintf(path, sizeof path, "pipelines/%s_jrg_pdgc.ini", Robot::kName);
  std::FILE* file = std::fopen(path, "r");
  assert_non_null(file);
  std::string gains;
  while (std::fgets(line, sizeof line, file) != nullptr)
    if (line[0] == 'k') gains += line;
  std::fclose(file);
  return gains;
}

/// kp among them.
inline JointVector pd_stiffness() {
  const std::string gains = pd_gains();
  const char* at = gains.c_str() + gains.find('=') + 1;
  JointVector kp;
  for (double& value : kp) {
    char* end = nullptr;
    value = std::strtod(at, &end);
    at = end;
  }
  return kp;
}

inline constexpr const char* kClosedLoopBlocks =
    "tau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n";

struct ClosedLoop {
  const char* blocks = kClosedLoopBlocks;  ///< set both before start() to use another pipeline
  std::string gains = pd_gains();
  ChannelMemory<JointSpace> channel;
  std::array<std::array<Waypoint<JointSpace>, 16>, kStores> waypoints;
  RoomyPipeline pipeline;
  PlantParams plant;
  SimHal hal;
  Executive executive{hal, pipeline};
  ReferenceClient<JointSpace> client{channel};
  LoadError error;
  std::int64_t cycles = 0;

  /// Loads the pipeline at `period_us`, builds the plant by `plant`, and takes over its drives. For
  /// an ideal plant set `plant` first.
  Status start(int period_us, std::uint64_t seed) {
    std::array<char, 1024> text;
    std::snprintf(text.data(), text.size(), "[robot]\nname = %s\nperiod_us = %d\n%s%s",
                  Robot::kName, period_us, blocks, gains.c_str());
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = 16;
    }
    Loader loader({&channel}, hal.capabilities());
    TRY(loader.load(text.data(), pipeline, error));
    hal.set_period(pipeline.robot.period_s());
    TRY(hal.load(plant, seed));
    return attach();
  }

  /// Takes over the drives.
  Status attach() {
    const std::int64_t period_ns = std::int64_t{1000} * pipeline.robot.period_us;
    std::int64_t now_ns = -period_ns;
    const Status status = start_armed(executive, period_ns, now_ns);
    cycles = now_ns / period_ns + 1;
    return status;
  }

  /// Sends a quintic from the ready pose by `offset` rad on every joint within `duration_s`.
  Verdict go(double offset, double duration_s) {
    Trajectory<JointSpace>& motion = *client.acquire();
    motion.count = 1;
    motion.fields = kVelocityField | kAccelerationField;
    motion.waypoints[0] = {};
    motion.waypoints[0].time_s = duration_s;
    motion.waypoints[0].point.q = plant.initial_q + JointVector::Constant(offset);
    std::uint32_t id = 0;
    return client.send(motion, id);
  }

  Status run(double duration_s) {
    const std::int64_t period_ns = std::int64_t{1000} * pipeline.robot.period_us;
    const std::int64_t end = cycles + static_cast<std::int64_t>(duration_s * 1e9) / period_ns;
    for (; cycles < end; ++cycles) TRY(executive.cycle({cycles * period_ns}));
    return Status::kOk;
  }

  JointVector q_d() const {
    return *static_cast<const JointVector*>(pipeline.ports.find("jrg.q_d")->value);
  }
};

}  // namespace tactus
