// A file of pipelines/ as the program runs it, with its trajectory, and beside it the true state of
// the plant.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "boards/program/files.hpp"
#include "boards/program/session.hpp"
#include "boards/program/trajectory_input.hpp"
#include "sim_plant/sim_hal.hpp"
#include "tests/testing.hpp"

namespace tactus {

/// For one run; static, for it is too large for a stack.
struct PipelineBench {
  static constexpr int kMaxWaypoints = 16;
  std::array<std::array<Waypoint<JointSpace>, kMaxWaypoints>, kStores> waypoints;
  std::array<std::array<Waypoint<TaskSpace>, kMaxWaypoints>, kStores> poses;
  ReferenceChannel<JointSpace> channel;
  ReferenceChannel<TaskSpace> task_channel;
  Pipeline pipeline;
  PlantParams plant;
  GatewaySection gateway;
  RealtimeSettings realtime;
  SimHal hal;
  Executive executive{hal, pipeline, nullptr};
  Recorder recorder{nullptr, 0};
  ReferenceClient<JointSpace> client{channel};
  ReferenceClient<TaskSpace> task_client{task_channel};
  std::string text;
  Session session{"test",   0,      {},          pipeline, executive,
                  recorder, client, task_client, gateway,  realtime};
  TrajectoryInput input;
  Report report;  ///< the last one
  std::int64_t cycles = 0;

  /// pipelines/<name>.ini, in it `from` replaced by `to`, with its own trajectory or another.
  void start(const char* name, const char* from = "", const char* to = "",
             const char* trajectory = "") {
    Options options;
    std::snprintf(options.pipeline, sizeof options.pipeline, "pipelines/%s.ini", name);
    std::snprintf(options.trajectory, sizeof options.trajectory, "%s", trajectory);
    load(options.pipeline, from, to);
    assert_true(read_input(session, options, input));
    hal.set_period(pipeline.robot.period_s());
    ASSERT_OK(hal.load(plant, 1));
    ASSERT_OK(executive.start());
    assert_true(send_input(session, input));
  }
  CycleTime next() { return {cycles++ * std::int64_t{1000} * pipeline.robot.period_us}; }
  void cycle() {
    ASSERT_OK(executive.cycle(next()));
    while (poll_report(session, input, report)) {
    }
  }
  double time_s() const { return static_cast<double>(cycles) * pipeline.robot.period_s(); }

  template <class Type>
  const Type& output(const char* port) const {
    const PortEntry* entry = pipeline.ports.find(port);
    assert_non_null(entry);
    return *static_cast<const Type*>(entry->value);
  }
  /// What the scene exerts on the tip in truth, N, base frame.
  Vector3 contact() const { return hal.arm().contact_force(); }
  std::uint32_t limited() const { return executive.guard().telemetry().limited_cycles; }

 private:
  void load(const char* path, const char* from, const char* to) {
    std::array<char, 8192> bytes;
    std::FILE* file = std::fopen(path, "r");
    assert_non_null(file);
    text.assign(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), file));
    std::fclose(file);
    const std::size_t at = text.find(from);
    assert_true(at != std::string::npos);
    text.replace(at, std::string_view(from).size(), to);
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      task_channel.stores[i].waypoints = poses[i].data();
      channel.stores[i].capacity = task_channel.stores[i].capacity = kMaxWaypoints;
    }
    Loader loader({&channel, &task_channel}, hal.capabilities());
    loader.add(board_section("plant", plant));
    loader.add(board_section("gateway", gateway));
    LoadError error;
    ASSERT_OK(loader.load(text, pipeline, error));
  }
};

}  // namespace tactus
