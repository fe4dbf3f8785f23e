// The whole loop in one object: pipeline, executive, generator and the simulated robot, for tests
// that look at the physics.
#pragma once

#include <array>
#include <cstdio>

#include "gateway/gateway_section.hpp"
#include "gateway/reference_client.hpp"
#include "kernel/executive.hpp"
#include "kernel/loader.hpp"
#include "sim_plant/sim_hal.hpp"

namespace tactus {

/// Gains of PD with gravity compensation in the paper's pipelines, N m/rad and N m s/rad.
template <class R>
struct PaperGains;
struct Fer;
struct Ur10;
template <>
struct PaperGains<Fer> {
  static constexpr std::array<double, 7> kp = {500, 400, 400, 300, 20, 20, 10};
  static constexpr const char* kText = "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n";
};
template <>
struct PaperGains<Ur10> {
  static constexpr std::array<double, 6> kp = {2000, 3000, 4000, 400, 400, 5};
  static constexpr const char* kText =
      "kp = 2000 3000 4000 400 400 5\nkd = 100 100 100 10 10 0.2\n";
};

inline constexpr const char* kClosedLoopBlocks =
    "tau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n";

struct ClosedLoop {
  const char* blocks = kClosedLoopBlocks;  ///< set both before start() for another pipeline
  const char* gains = PaperGains<Robot>::kText;
  ReferenceChannel<JointSpace> channel;
  std::array<std::array<Waypoint<JointSpace>, 16>, kStores> waypoints;
  Pipeline pipeline;
  PlantParams plant;
  SimHal hal;
  Executive executive{hal, pipeline, nullptr};
  ReferenceClient<JointSpace> client{channel};
  LoadError error;
  std::int64_t cycles = 0;

  /// Loads the pipeline at `period_us`, builds the plant as `plant` says, attaches. An ideal plant:
  /// set `plant` before.
  Status start(int period_us, std::uint64_t seed) {
    std::array<char, 1024> text;
    std::snprintf(text.data(), text.size(), "[robot]\nname = %s\nperiod_us = %d\n%s%s",
                  Robot::kName, period_us, blocks, gains);
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = 16;
    }
    Loader loader({&channel}, hal.capabilities());
    TRY(loader.load(text.data(), pipeline, error));
    hal.set_period(pipeline.robot.period_s());
    TRY(hal.load(plant, seed));
    return executive.start();
  }

  /// From the ready pose by `offset` rad on every joint within `duration_s`, quintic.
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
