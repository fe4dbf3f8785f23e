// Runs a file of pipelines/ as the program does, with its trajectory, and gives access to the true
// state of the plant.
#pragma once

#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <string>

#include "program/session/files.hpp"
#include "program/session/lateness.hpp"
#include "program/session/session.hpp"
#include "program/session/trajectory_input.hpp"
#include "program/sim/sim_sections.hpp"
#include "sim_plant/arm/sim_hal.hpp"
#include "tests/support/armed.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

/// Whether the pipeline's name begins with that of the robot.
inline bool is_of_this_robot(const std::string& pipeline) {
  return pipeline.rfind(std::string(Robot::kName) + "_", 0) == 0;
}

/// Skips the test, by its name, if none of its pipelines is of this robot.
inline void need_one_of(std::initializer_list<const char*> pipelines) {
  for (const char* pipeline : pipelines)
    if (is_of_this_robot(pipeline)) return;
  _skip(__FILE__, __LINE__);
}

/// Names of files that every robot has: the pipeline "_jrg_pdgc" and its trajectory
/// "_five_waypoints".
inline std::string of_this_robot(const char* rest) {
  return std::string(Robot::kName) + rest;
}
inline std::string five_waypoints() {
  return "pipelines/trajectories/" + of_this_robot("_five_waypoints.csv");
}

/// A bench for one run; static, because it is too large for a stack.
struct PipelineBench {
  static constexpr int kMaxWaypoints = 16;
  std::array<std::array<Waypoint<JointSpace>, kMaxWaypoints>, kStores> waypoints;
  std::array<std::array<Waypoint<TaskSpace>, kMaxWaypoints>, kStores> poses;
  ChannelMemory<JointSpace> channel;
  ChannelMemory<TaskSpace> task_channel;
  RoomyPipeline pipeline;
  SimSections board;
  SimHal hal;
  Executive executive{hal, pipeline};
  Recorder recorder{nullptr, 0};
  ReferenceClient<JointSpace> client{channel};
  ReferenceClient<TaskSpace> task_client{task_channel};
  std::string text;
  Session session{"test",        true,           0,           {},     hal,
                  pipeline,      executive,      recorder,    client, task_client,
                  board.gateway, board.realtime, board.expect};
  TrajectoryInput input;
  Report report;  ///< the last one
  std::int64_t cycles = 0;

  /// Starts pipelines/<name>.ini with `from` replaced by `to`, with its own trajectory or another.
  void start(const std::string& name, const char* from = "", const char* to = "",
             const std::string& trajectory = "") {
    Options options;
    std::snprintf(options.pipeline, sizeof options.pipeline, "pipelines/%s.ini", name.c_str());
    std::snprintf(options.trajectory, sizeof options.trajectory, "%s", trajectory.c_str());
    load(options.pipeline, from, to);
    assert_true(read_input(session, options, input));
    ASSERT_OK(arm());
    assert_true(send_input(session, input));
  }
  /// The same, for an arm that is not armed. Returns why.
  Status refused(const std::string& name, const char* from, const char* to) {
    load(("pipelines/" + name + ".ini").c_str(), from, to);
    return arm();
  }
  /// Arms the robot of a file with this text, and sends it nothing. Returns as arm() does.
  Status arm_with(const std::string& pipeline_text) {
    text = pipeline_text;
    load_text();
    return arm();
  }
  CycleTime next() { return {armed_ns_ + ++cycles * period_ns()}; }
  void cycle() {
    ASSERT_OK(executive.cycle(next()));
    while (poll_report(session, input, report)) {
    }
  }
  /// Time since the arm was taken over.
  double time_s() const { return static_cast<double>(cycles) * pipeline.robot.period_s(); }

  template <class Type>
  const Type& output(const char* port) const {
    const PortEntry* entry = pipeline.ports.find(port);
    assert_non_null(entry);
    return *static_cast<const Type*>(entry->value);
  }
  /// True force of the scene on the tip, N, base frame.
  Vector3 contact() const { return hal.arm().contact_force(); }
  std::uint32_t limited() const { return executive.guard().telemetry().limited_cycles; }

 private:
  Status arm() { return start_armed(executive, period_ns(), armed_ns_); }
  std::int64_t period_ns() const { return std::int64_t{1000} * pipeline.robot.period_us; }
  void load(const char* path, const char* from, const char* to) {
    std::array<char, 8192> bytes;
    std::FILE* file = std::fopen(path, "r");
    assert_non_null(file);
    text.assign(bytes.data(), std::fread(bytes.data(), 1, bytes.size(), file));
    std::fclose(file);
    const std::size_t at = text.find(from);
    assert_true(at != std::string::npos);
    text.replace(at, std::string_view(from).size(), to);
    load_text();
  }
  void load_text() {
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      task_channel.stores[i].waypoints = poses[i].data();
      channel.stores[i].capacity = task_channel.stores[i].capacity = kMaxWaypoints;
    }
    Loader loader({&channel, &task_channel}, hal.capabilities(), board);
    LoadError error;
    const Status status = loader.load(text, pipeline, error);
    if (status != Status::kOk) print_error("%s\n", error.message().c_str());
    ASSERT_OK(status);
    assert_true(settle_lateness("text", text,
                                following(pipeline, board.plant.servo_time_constant_s), pipeline));
    hal.set_period(pipeline.robot.period_s());
    board.plant.arming_cycles = 200;  // as drives on a bus do
    ASSERT_OK(hal.load(board.plant, 1));
  }

  std::int64_t armed_ns_ = 0;
};

}  // namespace tactus
