#include "boards/program/sim_board.hpp"

#include <cstdio>

#include "boards/program/board_memory.hpp"
#include "boards/program/doctor.hpp"
#include "boards/program/files.hpp"
#include "sim_plant/sim_hal.hpp"

namespace tactus {
namespace {

/// Everything of fixed size, and so the memory figure of the board.
struct Memory : BoardMemory {
  PlantParams plant;
};

}  // namespace

int run_sim_board(int argc, char** argv, const char* board) {
  Options options;
  int exit_code = kSucceeded;
  if (!parse_options(argc, argv, board, options, exit_code)) return exit_code;

  if (options.verb == Verb::kDoctor) return doctor(options);
  if (options.verb == Verb::kJitter) return jitter(options);
  static Memory memory;
  static SimHal hal;
  if (options.verb == Verb::kPorts) return print_ports(board, hal.capabilities());
  Loader loader(memory.channels(), hal.capabilities());
  loader.add(board_section("plant", memory.plant));
  loader.add(board_section("gateway", memory.gateway));
  loader.add(board_section("realtime", memory.realtime));
  std::string_view text;
  if (!load_pipeline(options.pipeline, loader, memory.pipeline, text)) return kRefused;

  static Recorder recorder(memory.recorder_ring.data(), memory.recorder_ring.size());
  static Executive executive(hal, memory.pipeline, stopwatch_ns);
  static ReferenceClient<JointSpace> client(memory.channel);
  static ReferenceClient<TaskSpace> task_client(memory.task_channel);
  const std::size_t static_bytes =
      sizeof memory + sizeof recorder + sizeof executive + sizeof client + sizeof task_client;
  Session session{board,    static_bytes, text,        memory.pipeline, executive,
                  recorder, client,       task_client, memory.gateway,  memory.realtime};
  if (options.verb == Verb::kCheck) {
    RobotState initial;
    initial.q = memory.plant.initial_q;
    return check(session, options, initial);
  }
  hal.set_period(memory.pipeline.robot.period_s());
  if (const Status status = hal.load(memory.plant, options.seed); status != Status::kOk) {
    std::fprintf(stderr, "%s: the plant: %s\n", options.pipeline, name(status));
    return kRefused;
  }
  return run(session, options);
}

}  // namespace tactus
