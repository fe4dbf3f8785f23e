// `tactus run`: everything around the cycles of a run, from the trajectory to the figure.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boards/program/figure.hpp"
#include "boards/program/heap_count.hpp"
#include "boards/program/run_loop.hpp"
#include "boards/program/session.hpp"
#include "boards/program/waypoint_log.hpp"

namespace tactus {
namespace {

constexpr double kDefaultDuration_s = 10.0;  // of a run without a trajectory

double planned_duration(const Session& session, const Options& options,
                        const TrajectoryInput& input) {
  if (options.duration_s > 0.0) return options.duration_s;
  if (!input.given()) return kDefaultDuration_s;
  return input.start_s + input.end_s() + session.gateway.settle_s;
}

FilePath in_folder(const FilePath& folder, const char* file) {
  FilePath path = folder;
  return path << "/" << file, path;
}

Status record(void* recorder, const RobotState&, double time_s) {
  static_cast<Recorder*>(recorder)->record(time_s);
  return Status::kOk;  // a full ring drops the row and counts it
}

void print_collision(const Collision::Telemetry& told) {
  std::fprintf(stderr, "  %s with %s, %s\n", told.first, told.second,
               told.predicted ? "before the arm could have come to rest" : "now");
}

/// Runs the loop between start and stop, and the times and counters around it.
void execute(Session& session, const Options& options, TrajectoryInput& input, RunLog& log,
             LogWriter& writer, RunResult& result) {
  const double duration_s = planned_duration(session, options, input);
  Progress progress(stem(options.pipeline), duration_s);
  const double begin_s = wall_s();
  const Status started = session.executive.start();
  if (input.given()) end_with(result, kEndedOtherwise, "unfinished");
  if (started != Status::kOk) {
    end_with(result, static_cast<int>(started), name(started));
  } else if (send_input(session, input)) {
    const auto cycles = std::max(1LL, std::llround(duration_s / session.pipeline.robot.period_s()));
    RunLoop loop(session, input, result);
    if (session.trigger != nullptr)
      loop.at_robots_pace(cycles, writer, progress);
    else if (options.realtime)
      loop.in_real_time(cycles, writer, progress);
    else
      loop.in_lock_step(cycles, log, progress);
  }
  const Status latched = session.executive.latched();
  result.rung = session.executive.rung();
  session.executive.stop();
  result.wall_s = wall_s() - begin_s;
  result.simulated_s =
      static_cast<double>(session.executive.telemetry().cycles) * session.pipeline.robot.period_s();
  result.heap_allocations = heap_allocations();
  progress.end();
  if (latched == Status::kOk) return;
  const Trigger* robot = session.trigger;
  const Message trouble = robot != nullptr ? robot->trouble(robot->robot) : Message();
  print_stop(options.pipeline, started == Status::kOk ? "stopped" : "refused", latched,
             session.executive.guard().telemetry(), trouble);
  if (latched == Status::kCollision) print_collision(session.pipeline.collision_check.telemetry());
}

}  // namespace

void print_stop(const char* subject, const char* event, Status status,
                const Guard::Telemetry& guard, std::string_view trouble) {
  std::fprintf(stderr, "%s: %s: %s", subject, event, name(status));
  if (guard.tripped_joint >= 0)
    std::fprintf(stderr, ", joint %d (%s): value %.9g, limit %.9g", guard.tripped_joint + 1,
                 Robot::kJointNames[static_cast<std::size_t>(guard.tripped_joint)],
                 guard.tripped_value, guard.tripped_limit);
  if (!trouble.empty())
    std::fprintf(stderr, ": %.*s", static_cast<int>(trouble.size()), trouble.data());
  std::fprintf(stderr, "\n");
}

int run(Session& session, const Options& options) {
  const std::string_view pipeline = stem(options.pipeline);
  FilePath folder(options.out);
  if (folder.empty()) folder << "out/" << pipeline;
  TrajectoryInput input;
  if (!read_input(session, options, input)) return kRefused;
  RunLog log;
  LogWriter writer(log);
  Realtime realtime;
  if (options.realtime && !(writer.start() && prepare(realtime, session.realtime))) return kRefused;
  if (!make_folder(folder)) return kRefused;
  const Recording& recording = session.pipeline.recording;
  if (!log.open(in_folder(folder, "log.csv").c_str(), recording)) return kRefused;

  static RunResult result;
  result.seed = options.seed;
  result.stretch = input.stretch();
  result.realtime.asked = options.realtime;
  result.realtime.report = realtime.report();
  result.config_hash = fnv1a_of_file(input.path.c_str(), fnv1a(session.text));
  for (; result.tracking_count < recording.tracking_count; ++result.tracking_count) {
    const auto i = static_cast<std::size_t>(result.tracking_count);
    result.tracking[i].start(recording.tracking[i]);
  }
  session.recorder.start(recording);
  session.pipeline.schedule.bind("recorder", record, &session.recorder);
  if (!options.realtime) session.executive.in_virtual_time();
  catch_interrupts();
  execute(session, options, input, log, writer, result);
  realtime.release();  // the figure's program would inherit it

  bool written = log.close();
  written &= write_summary(in_folder(folder, "summary.json").c_str(), pipeline, session, result);
  if (input.given() && recording.tracking_count > 0)
    written &= write_waypoints(in_folder(folder, "waypoints.csv").c_str(), input,
                               *recording.tracking[0].reference);
  print_table(pipeline, session, result);
  if (input.stretch() > 0.0)
    std::printf("  trajectory accepted, %.1f %% longer\n", 100.0 * input.stretch());
  if (!written) std::fprintf(stderr, "%s: not everything could be written\n", folder.c_str());
  if (options.figure && written) draw_figure(folder.c_str());
  std::printf("  written to %s\n", folder.c_str());
  if (session.executive.telemetry().cycles == 0) return kRefused;
  return result.code == 0 && written ? kSucceeded : kEndedOtherwise;
}

}  // namespace tactus
