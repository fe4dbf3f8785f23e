// ur10_socket: a Universal Robots UR10 behind its own ports; its clock is the master.
#include <cstdio>

#include "boards/program/board_memory.hpp"
#include "boards/program/doctor.hpp"
#include "boards/program/files.hpp"
#include "hal/ur/ur_hal.hpp"

namespace tactus {
namespace {

constexpr const char* kBoard = "ur10_socket";

struct Memory : BoardMemory {
  ur::UrSettings ur;
};

std::int64_t wait(void* robot) {
  return static_cast<ur::UrHal*>(robot)->wait();
}
Message trouble(void* robot) {
  return static_cast<ur::UrHal*>(robot)->trouble();
}

/// From where the robot stands.
int check_there(Session& session, const Options& options, ur::UrHal& hal) {
  RobotState state;
  const Status status = hal.look(state);
  if (status == Status::kOk) return check(session, options, state);
  print_stop(options.pipeline, "refused", status, {}, hal.trouble());
  return kRefused;
}

int run_board(int argc, char** argv) {
  Options options;
  int exit_code = kSucceeded;
  if (!parse_options(argc, argv, kBoard, options, exit_code)) return exit_code;
  options.realtime = true;  // there is no other time
  if (options.verb == Verb::kDoctor) return doctor(options);
  if (options.verb == Verb::kJitter) return jitter(options);
  static Memory memory;
  static ur::UrHal hal;
  if (options.verb == Verb::kPorts) return print_ports(kBoard, hal.capabilities());

  Loader loader(memory.channels(), hal.capabilities());
  loader.add(board_section("ur", memory.ur));
  loader.add(board_section("gateway", memory.gateway));
  loader.add(board_section("realtime", memory.realtime));
  std::string_view text;
  if (!load_pipeline(options.pipeline, loader, memory.pipeline, text)) return kRefused;
  const RobotSection& robot = memory.pipeline.robot;
  Tool tool{robot.tool_mass, robot.tool_com, {}};
  tool.tip.p = robot.tool_tip;
  hal.configure(memory.ur, tool, robot.period_us);

  static Recorder recorder(memory.recorder_ring.data(), memory.recorder_ring.size());
  static Executive executive(hal, memory.pipeline, stopwatch_ns);
  static ReferenceClient<JointSpace> client(memory.channel);
  static ReferenceClient<TaskSpace> task_client(memory.task_channel);
  static const Trigger trigger = {wait, trouble, &hal};
  const std::size_t static_bytes = sizeof memory + sizeof hal + sizeof recorder + sizeof executive +
                                   sizeof client + sizeof task_client;
  Session session{kBoard, static_bytes, text,           memory.pipeline, executive, recorder,
                  client, task_client,  memory.gateway, memory.realtime, &trigger};
  if (options.verb == Verb::kCheck) return check_there(session, options, hal);
  return run(session, options);
}

}  // namespace
}  // namespace tactus

int main(int argc, char** argv) {
  return tactus::run_board(argc, argv);
}
