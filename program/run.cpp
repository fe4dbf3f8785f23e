// `tactus run`: a run from the reading of its trajectory to the figure, but for its cycles.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "gateway/fnv1a.hpp"
#include "gateway/verdict_text.hpp"
#include "program/heap_count.hpp"
#include "program/results/figure.hpp"
#include "program/results/run_folder.hpp"
#include "program/results/run_recording.hpp"
#include "program/results/scene_file.hpp"
#include "program/results/waypoint_log.hpp"
#include "program/run_loop.hpp"
#include "program/session/session.hpp"

namespace tactus {
namespace {

constexpr double kUntimedRun_s = 10.0;  // without a trajectory

double planned_duration(const Session& session, const Options& options,
                        const TrajectoryInput& input) {
  if (options.duration_s > 0.0) return options.duration_s;
  if (!input.given()) return kUntimedRun_s;
  if (!input.whole_known()) return kInfinity;
  return input.start_s + input.duration_s() + session.gateway.settle_s;
}

/// Returns the cycles that cover a time, at least one; rounding is no cycle.
std::int64_t cycles_of(double duration_s, double period_s) {
  constexpr double kRounding = 1e-6;  // of a cycle
  return std::max<std::int64_t>(1, std::llround(std::ceil(duration_s / period_s - kRounding)));
}

/// Connects, runs the loop, stops the executive, and takes times and counters. The watchdog runs
/// from the first cycle on, because connecting may take longer than its timeout.
void execute(Session& session, const Options& options, TrajectoryInput& input, TrajectoryFeed& feed,
             RunLog& log, LogWriter& writer, WatchdogThread& watchdog, RunResult& result) {
  const double duration_s = planned_duration(session, options, input);
  Progress progress(stem(options.pipeline), duration_s);
  const double begin_s = wall_s();
  RunLength length;
  length.fixed = options.duration_s > 0.0;
  if (duration_s < kInfinity)
    length.cycles = cycles_of(duration_s, session.pipeline.robot.period_s());
  RunLoop loop(session, input, feed, watchdog, result, length);
  if (log.recording() != nullptr) loop.record(*log.recording());
  if (input.given()) end_with(result, kEndedOtherwise, "unfinished");
  const bool started = loop.start();
  print_written(options.pipeline, session);
  const bool guarded = started && watchdog.arm(session.realtime);
  if (started && !guarded) end_with(result, kRefused, "refused");
  if (guarded) {
    if (session.hal.clock() != nullptr)
      loop.at_robots_pace(*session.hal.clock(), writer, progress);
    else if (options.realtime)
      loop.in_real_time(writer, progress);
    else
      loop.in_lock_step(log, progress);
  } else {
    loop.stop();
  }
  feed.end();
  watchdog.disarm();
  result.wall_s = wall_s() - begin_s;
  result.simulated_s = loop.time_s();
  result.cycles = loop.commanded();
  if (result.code != 0) result.why = loop.why();
  result.heap_allocations = heap_allocations();
  progress.end();
  if (result.code == kEndedOtherwise && result.fault == Status::kOk && !result.why.empty())
    std::fprintf(stderr, "%s: %s: %s\n", input.path.c_str(), result.name, result.why.c_str());
  if (!loop.ended_as_planned() && (guarded || !started)) explain(session, options, loop);
  if (loop.left() == Status::kOk) return;
  print_stop(options.pipeline, "not disabled", loop.left(), loop.left_trouble());
  if (result.code != 0) return;
  end_with(result, kEndedOtherwise, "drives not disabled");
  result.why = stop_reason(loop.left(), loop.left_trouble());
}

RunInputs inputs_of(const Options& options, const TrajectoryInput& input) {
  return {options.pipeline, input.path.empty() ? nullptr : input.path.c_str()};
}

/// Writes all files but the log and the figures, up to the first that cannot be written; false:
/// prints which.
bool write_results(RunFolder& folder, const Session& session, const TrajectoryInput& input,
                   std::string_view pipeline, const RunResult& result) {
  const Recording& recording = session.pipeline.recording;
  if (!write_scene(folder.file("scene.json").c_str(), session.pipeline)) return false;
  if (input.given() && recording.tracking_count > 0 &&
      !write_waypoints(folder.file("waypoints.csv").c_str(), input,
                       *recording.tracking[0].reference))
    return false;
  const FilePath summary = folder.summary_part();
  if (write_summary(summary.c_str(), pipeline, session, result))
    return folder.complete(result.cycles > 0);
  std::remove(summary.c_str());
  return false;
}

/// Refuses a file like ".ini" or "...ini", whose results would go to out/ or beside it.
int refuse_name(const char* path) {
  std::fprintf(stderr,
               "%s: refused: its name gives no folder for the results; rename it, or give --out\n",
               path);
  return kRefused;
}

/// Says how the trajectory was changed, where the files are, and what compares them with the
/// expected lag or force.
void print_files(const TrajectoryInput& input, const RunResult& result, const FilePath& folder,
                 bool written) {
  if (input.stretch() > 0.0)
    std::printf("  trajectory made %.1f %% longer to stay within limits\n",
                100.0 * input.stretch());
  if (input.smoothing().tolerance.allows())
    std::printf("  trajectory %s\n", describe(input.moved()).c_str());
  if (result.starved > 0)
    std::printf("  waits on the path for %s, which came too slowly: %d\n", input.path.c_str(),
                result.starved);
  if (!written) {
    std::printf("  incomplete: %s\n", folder.c_str());
    return;
  }
  std::string_view path = folder;
  while (path.size() > 1 && path.back() == '/') path.remove_suffix(1);
  const std::size_t slash = path.rfind('/');
  const FilePath parent(slash == std::string_view::npos ? "." : path.substr(0, slash + 1));
  const FilePath name(slash == std::string_view::npos ? path : path.substr(slash + 1));
  std::printf("  written to %s; seen and expected: scripts/report %s %s\n", folder.c_str(),
              parent.c_str(), name.c_str());
}

/// A run that has not seen what its file states does not succeed. One that was stopped as it
/// states has not failed by that.
void judge(const Session& session, const Options& options, RunResult& result) {
  Expectation& expectation = result.expectation;
  StopExpectation& stop = expectation.stop();
  expectation.take(result.tracking.data(), result.tracking_count);
  stop.take(result.fault, session.pipeline.collision_check.telemetry(),
            result.cycles > 0 && session.executive.at_rest());
  if (stop.stated() && stop.met()) {
    end_with(result, 0, "succeeded");
    result.fault = Status::kOk;
    result.why = {};
  }
  if (expectation.met() || (result.code != 0 && stop.met())) return;
  if (result.code == 0) end_with(result, kEndedOtherwise, "not as stated");
  expectation.print_misses(options.pipeline);
}

}  // namespace

Reason stop_reason(const FaultVerdict& fault, std::string_view trouble) {
  Reason text(describe(fault.verdict, fault.axes));
  if (!trouble.empty()) text << ": " << trouble;
  return text;
}

void print_stop(const char* subject, const char* event, const FaultVerdict& fault,
                std::string_view trouble) {
  std::fprintf(stderr, "%s: %s: %s\n", subject, event, stop_reason(fault, trouble).c_str());
}

void print_collision(const Collision::Telemetry& telemetry) {
  std::fprintf(stderr, "  %s with %s, %s\n", telemetry.first, telemetry.second,
               telemetry.unproved    ? "not proved apart with the directions of a cycle"
               : telemetry.predicted ? "before the arm could have come to rest"
                                     : "at the present position");
}

void explain(const Session& session, const Options& options, const RunLoop& loop) {
  const Status latched = loop.latched();
  if (latched == Status::kOk) return;
  if (loop.cut_short())
    std::fprintf(stderr, "%s: interrupted while connecting to the robot\n", options.pipeline);
  else
    print_stop(options.pipeline, loop.armed() ? "stopped" : "refused", loop.fault(),
               loop.trouble());
  if (const Reason before = loop.gave_up(); !before.empty())
    std::fprintf(stderr, "  after its goal was given up: %s\n", before.c_str());
  if (latched == Status::kCollision) print_collision(session.pipeline.collision_check.telemetry());
}

int run(Session& session, const Options& options) {
  const std::string_view pipeline = stem(options.pipeline);
  if (options.out[0] == '\0' && (pipeline.empty() || pipeline == "." || pipeline == ".."))
    return refuse_name(options.pipeline);
  RunFolder folder(options);
  static RunResult result;
  static TrajectoryInput input;  // too large for a stack that is locked in memory
  static RunRecording recorded;
  RunLog log;
  LogWriter writer(log);
  TrajectoryFeed feed(session, input);
  WatchdogThread watchdog;
  Realtime realtime;
  const bool accepted =
      read_input(session, options, input) &&
      result.expectation.start(session.expect, session.pipeline, options.pipeline);
  if (!accepted ||
      (options.realtime && !(writer.start() && feed.start() && watchdog.start(session.realtime) &&
                             prepare(realtime, session.realtime)))) {
    folder.refuse(inputs_of(options, input));
    return kRefused;
  }
  if (!folder.begin(inputs_of(options, input), session.text)) return kRefused;
  print_long_way(input);
  const Recording& recording = session.pipeline.recording;
  if (options.log && !log.open(folder.file("log.csv").c_str(), recording)) return kRefused;

  const bool records = options.record[0] != '\0';
  if (records && !recorded.open(options.record, session)) return kRefused;
  if (records) log.record(recorded);

  result.overrides = &options.overrides;
  result.seed = options.seed;
  result.realtime.asked = options.realtime;
  result.realtime.report = realtime.report();
  for (; result.tracking_count < recording.tracking_count; ++result.tracking_count) {
    const auto i = static_cast<std::size_t>(result.tracking_count);
    result.tracking[i].start(recording.tracking[i]);
  }
  if (options.log || records) start_recorder(session.recorder, session.pipeline);
  if (!options.realtime) session.executive.in_virtual_time();
  catch_interrupts();
  execute(session, options, input, feed, log, writer, watchdog, result);
  result.stretch = input.stretch();
  result.moved = input.moved();
  result.config_hash = input.hash(fnv1a(session.text));
  realtime.release();  // or the program that draws the figure would inherit it

  judge(session, options, result);
  const bool written = (!options.log || log.close()) && (!records || recorded.close(result)) &&
                       write_results(folder, session, input, pipeline, result);
  if (!written && result.code == 0) end_with(result, kEndedOtherwise, "not recorded");
  print_table(pipeline, session, result);
  if (options.figure && written) draw_figure(folder.path().c_str());
  print_files(input, result, folder.path(), written);
  if (result.cycles == 0) return kRefused;
  return result.code == 0 && written ? kSucceeded : kEndedOtherwise;
}

}  // namespace tactus
