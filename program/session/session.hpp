// Session: the objects of a board as the program's verbs see them. The board owns them all.
#pragma once

#include <string_view>

#include "gateway/gateway_section.hpp"
#include "gateway/reference_client.hpp"
#include "gateway/verdict_text.hpp"
#include "hal/os/realtime_settings.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/pipeline/channels.hpp"
#include "program/session/expect_section.hpp"
#include "program/session/follower.hpp"
#include "program/session/options.hpp"
#include "program/session/wire_counts.hpp"

namespace tactus {

/// Why a run ended as it did, in words.
using Reason = Text<767>;

struct Following;

struct Session {
  const char* board;
  bool simulated;            ///< the robot is a plant in this program
  std::size_t static_bytes;  ///< of all objects of the kernel and the gateway on this board
  std::string_view text;     ///< of the pipeline file
  Hal& hal;
  Pipeline& pipeline;
  Executive& executive;
  Recorder& recorder;
  ReferenceClient<JointSpace>& client;
  ReferenceClient<TaskSpace>& task_client;
  const GatewaySection& gateway;
  const RealtimeSettings& realtime;
  const ExpectSection& expect;
  Follower* follower = nullptr;      ///< null: there is none
  WireCounts (*counts)() = nullptr;  ///< null: its wire counts nothing
  /// Returns change `n`, from 0, that start-ups made in the robot; null: they make none.
  Message (*written)(int n) = nullptr;
  Message (*to_home)() = nullptr;        ///< null: arming homes no joint
  const Following* following = nullptr;  ///< how the joints follow; null: not rehearsed
};

/// `tactus run`: runs the pipeline in lock-step with the plant's virtual time, or in real time, and
/// writes log, summary and figure. Returns the exit code.
int run(Session& session, const Options& options);

/// `tactus serve`: runs the pipeline in real time for clients that connect to it, until a signal.
/// Returns the exit code.
int serve(Session& session, const Options& options);

/// `tactus check`: judges pipeline and trajectory as `run` would, from where the robot is; no drive
/// is enabled. Returns the exit code.
int check(Session& session, const Options& options);

/// Connects, reads the state of the robot and disconnects; no drive is enabled.
Status look(Hal& hal, CommandMode mode, RobotState& state);

/// Prints what start-ups have changed in the robot.
void print_written(const char* path, const Session& session);

/// Returns a fault in words, with joint or axis, value and limit if they are known, then the
/// robot's own reason.
Reason stop_reason(const FaultVerdict& fault, std::string_view trouble = {});
/// Prints "subject: event: " and the reason.
void print_stop(const char* subject, const char* event, const FaultVerdict& fault,
                std::string_view trouble = {});
/// Prints the pair of a contact.
void print_collision(const Collision::Telemetry& telemetry);

}  // namespace tactus
