// Session: the objects of a board as the program's verbs see them. The board owns them all.
#pragma once

#include <string_view>

#include "boards/program/options.hpp"
#include "gateway/gateway_section.hpp"
#include "gateway/reference_client.hpp"
#include "hal/os/realtime_settings.hpp"
#include "kernel/executive.hpp"

namespace tactus {

/// What begins the cycles on a board whose robot has the clock.
struct Trigger {
  std::int64_t (*wait)(void* robot) = nullptr;  ///< until the next one is due; its stamp, ns
  Message (*trouble)(void* robot) = nullptr;    ///< what the robot says of the Status that ended it
  void* robot = nullptr;
};

struct Session {
  const char* board;
  std::size_t static_bytes;  ///< of all objects of the kernel and the gateway on this board
  std::string_view text;     ///< of the pipeline file
  Pipeline& pipeline;
  Executive& executive;
  Recorder& recorder;
  ReferenceClient<JointSpace>& client;
  ReferenceClient<TaskSpace>& task_client;
  const GatewaySection& gateway;
  const RealtimeSettings& realtime;
  const Trigger* trigger = nullptr;  ///< none: the host's clock, or the plant's virtual time
};

/// `tactus run`: runs the pipeline in lock-step with the plant's virtual time, or in real time, and
/// writes log, summary and figure. Returns the exit code.
int run(Session& session, const Options& options);

/// `tactus check`: judges pipeline and trajectory as `run` would, from `initial` on; nothing moves.
/// Returns the exit code.
int check(Session& session, const Options& options, const RobotState& initial);

/// `tactus ports`: prints every block, port, unit, setting, default and range as Markdown. Returns
/// the exit code.
int print_ports(const char* board, const Capabilities& offered);

/// Prints "subject: event: status" and, if it was the guard's, joint, value and limit; then what
/// the robot says of it.
void print_stop(const char* subject, const char* event, Status status,
                const Guard::Telemetry& guard, std::string_view trouble = {});

}  // namespace tactus
