// run_board: the program of every board on Linux. A board is a robot behind its Hal, and the
// sections that it adds to a pipeline file.
#pragma once

#include <cstdio>

#include "gateway/verdict_text.hpp"
#include "program/board_memory.hpp"
#include "program/host/doctor.hpp"
#include "program/ports.hpp"
#include "program/results/run_folder.hpp"
#include "program/session/files.hpp"
#include "program/session/lateness.hpp"
#include "program/session/trajectory_input.hpp"

namespace tactus {

/// Returns the exit code of a program that has refused the pipeline file.
inline int refused(const Options& options) {
  if (options.verb == Verb::kRun) RunFolder(options).refuse({options.pipeline, options.trajectory});
  return kRefused;
}

template <class Sections>
struct Board {
  const char* name;
  Hal& hal;
  std::size_t hal_bytes;  ///< of its memory figure; a simulated robot is not part of it
  bool real;              ///< it has no virtual time
  /// Hands the settings of a loaded file to the Hal.
  Status (*configure)(const Sections& sections, const Pipeline& pipeline, const Options& options);
  int (*scan)(const Options& options) = nullptr;  ///< the verb `scan`, on a board with a bus
  Follower* follower = nullptr;      ///< a second machine that runs the same, if there is one
  WireCounts (*counts)() = nullptr;  ///< after a run; null: its wire counts nothing
  /// Returns change `n`, from 0, that start-ups made in the robot; empty behind the last.
  Message (*written)(int n) = nullptr;
  Message (*to_home)() = nullptr;  ///< joints that arming homes; null: it homes none
  /// Time constant of the robot's servo for positions, s; null: it is not known.
  double (*servo_s)(const Sections& sections) = nullptr;
};

/// Owns every object of the board but its Hal, as statics, and allocates nothing after them.
/// Returns the exit code of the program.
template <class Sections>
int run_board(int argc, char** argv, const Board<Sections>& board) {
  Options options;
  int exit_code = kSucceeded;
  if (!parse_options(argc, argv, board.name, board.scan != nullptr, options, exit_code))
    return exit_code;
  if (options.virtual_time && board.real) {
    std::fprintf(stderr, "--virtual-time: refused: %s has no virtual time; leave it out\n",
                 board.name);
    return kRefused;
  }
  options.realtime = options.realtime || board.real || options.verb == Verb::kServe;
  if (options.verb == Verb::kDoctor) return doctor(options);
  if (options.verb == Verb::kJitter) return jitter(options);
  if (options.verb == Verb::kScan && board.scan != nullptr) return board.scan(options);

  static BoardMemory memory;
  static Sections sections;
  Pipeline& pipeline = memory.pipeline;
  const Capabilities offered = board.hal.capabilities();
  if (options.verb == Verb::kPorts) return print_ports(board.name, offered, pipeline, sections);
  Loader loader(memory.channels(), offered, sections);
  std::string_view text;
  if (!load_pipeline(options.pipeline, loader, pipeline, text, options.overrides))
    return refused(options);
  const Following loop =
      following(pipeline, board.servo_s != nullptr ? board.servo_s(sections) : 0.0);
  if (!settle_lateness(options.pipeline, text, loop, pipeline)) return refused(options);
  const Status status = board.configure(sections, pipeline, options);
  if (status != Status::kOk) {
    const Message trouble = board.hal.trouble();
    std::fprintf(stderr, "%s: robot: %s%s%s\n", options.pipeline, describe(status).c_str(),
                 trouble.empty() ? "" : ": ", trouble.c_str());
    return refused(options);
  }

  static Recorder recorder(memory.recorder_ring.data(), memory.recorder_ring.size());
  static Executive executive(board.hal, pipeline, {stopwatch_ns, memory.times});
  static ReferenceClient<JointSpace> client(memory.channel);
  static ReferenceClient<TaskSpace> task_client(memory.task_channel);
  const std::size_t static_bytes = sizeof memory + sizeof sections + board.hal_bytes +
                                   sizeof recorder + sizeof executive + sizeof client +
                                   sizeof task_client + sizeof(TrajectoryInput);
  Session session{board.name,      !board.real,    static_bytes,     text,
                  board.hal,       pipeline,       executive,        recorder,
                  client,          task_client,    sections.gateway, sections.realtime,
                  sections.expect, board.follower, board.counts,     board.written,
                  board.to_home,   &loop};
  if (board.follower != nullptr) board.follower->prepare(session);
  switch (options.verb) {
    case Verb::kCheck: return check(session, options);
    case Verb::kServe: return serve(session, options);
    default: return run(session, options);
  }
}

}  // namespace tactus
