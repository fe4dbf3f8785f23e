// `tactus run`: cycles in lock-step with the plant's virtual time, as fast as the host can.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "boards/program/figure.hpp"
#include "boards/program/heap_count.hpp"
#include "boards/program/run_log.hpp"
#include "boards/program/session.hpp"
#include "boards/program/summary.hpp"
#include "boards/program/trajectory_input.hpp"
#include "boards/program/waypoint_log.hpp"

namespace tactus {
namespace {

constexpr double kDefaultDuration_s = 10.0;  // of a run without a trajectory

volatile std::sig_atomic_t interrupted = 0;

void on_signal(int) {
  interrupted = 1;
}

void end_with(RunResult& result, int code, const char* name) {
  result.code = code;
  result.name = name;
}

double wall_s() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// One line that rewrites itself, a few times a second, when somebody looks.
class Progress {
 public:
  Progress(std::string_view pipeline, double duration_s)
      : pipeline_(pipeline), duration_s_(duration_s), shown_(isatty(STDERR_FILENO) != 0) {}
  void update(double time_s) {
    if (!shown_ || wall_s() < next_) return;
    next_ = wall_s() + 0.1;
    std::fprintf(stderr, "\r%.*s: %3.0f %%", static_cast<int>(pipeline_.size()), pipeline_.data(),
                 100.0 * time_s / duration_s_);
  }
  void end() const {
    if (shown_) std::fprintf(stderr, "\r%*s\r", 60, "");
  }

 private:
  std::string_view pipeline_;
  double duration_s_;
  bool shown_;
  double next_ = 0.0;
};

/// What the reports say of the trajectory; a run succeeds when it has one and that succeeds, or has
/// none. False: there is nothing to go on for.
bool follow(Session& session, const TrajectoryInput& input, RunResult& result) {
  Report report;
  while (poll_report(session, input, report)) {
    if (report.id != input.id || report.outcome == Outcome::kScheduled ||
        report.outcome == Outcome::kStarted)
      continue;
    const bool refused = report.outcome == Outcome::kRefused;
    end_with(result,
             refused                                 ? static_cast<int>(report.verdict.status)
             : report.outcome == Outcome::kSucceeded ? 0
                                                     : kEndedOtherwise,
             name(report.outcome));
    if (!refused) continue;
    print_verdict(input, report.verdict);
    return false;
  }
  return true;
}

void cycle_through(Session& session, double duration_s, const TrajectoryInput& input, RunLog& log,
                   Progress& progress, RunResult& result) {
  const double period_s = session.pipeline.robot.period_s();
  const std::int64_t period_ns = std::int64_t{1000} * session.pipeline.robot.period_us;
  const auto cycles = std::max(1LL, std::llround(duration_s / period_s));
  Status status = Status::kOk;
  bool goes_on = true;
  for (std::int64_t k = 0; k < cycles && goes_on && status == Status::kOk; ++k) {
    {
      const HeapWatch watch;
      status = session.executive.cycle({k * period_ns});
    }
    for (int i = 0; i < result.tracking_count; ++i)
      result.tracking[static_cast<std::size_t>(i)].add();
    goes_on = follow(session, input, result);
    if (interrupted != 0) {
      end_with(result, kEndedOtherwise, "interrupted");
      goes_on = false;
    }
    log.drain(session.recorder);
    progress.update(static_cast<double>(k) * period_s);
  }
  if (status != Status::kOk) end_with(result, static_cast<int>(status), name(status));
}

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

/// Runs the loop between start and stop, and the times and counters around it.
void execute(Session& session, const Options& options, TrajectoryInput& input, RunLog& log,
             RunResult& result) {
  const double duration_s = planned_duration(session, options, input);
  Progress progress(stem(options.pipeline), duration_s);
  const double begin_s = wall_s();
  const Status started = session.executive.start();
  if (input.given()) end_with(result, kEndedOtherwise, "unfinished");
  if (started != Status::kOk)
    end_with(result, static_cast<int>(started), name(started));
  else if (send_input(session, input))
    cycle_through(session, duration_s, input, log, progress, result);
  const Status latched = session.executive.latched();
  session.executive.stop();
  result.wall_s = wall_s() - begin_s;
  result.simulated_s =
      static_cast<double>(session.executive.telemetry().cycles) * session.pipeline.robot.period_s();
  result.heap_allocations = heap_allocations();
  progress.end();
  if (latched != Status::kOk)
    print_stop(options.pipeline, started == Status::kOk ? "stopped" : "refused", latched,
               session.executive.guard().telemetry());
}

}  // namespace

void print_stop(const char* subject, const char* event, Status status,
                const Guard::Telemetry& guard) {
  std::fprintf(stderr, "%s: %s: %s", subject, event, name(status));
  if (guard.tripped_joint >= 0)
    std::fprintf(stderr, ", joint %d (%s): value %.9g, limit %.9g", guard.tripped_joint + 1,
                 Robot::kJointNames[static_cast<std::size_t>(guard.tripped_joint)],
                 guard.tripped_value, guard.tripped_limit);
  std::fprintf(stderr, "\n");
}

int run(Session& session, const Options& options) {
  const std::string_view pipeline = stem(options.pipeline);
  FilePath folder(options.out);
  if (folder.empty()) folder << "out/" << pipeline;
  TrajectoryInput input;
  if (!read_input(session, options, input)) return kRefused;
  if (!make_folder(folder)) return kRefused;
  const Recording& recording = session.pipeline.recording;
  RunLog log;
  if (!log.open(in_folder(folder, "log.csv").c_str(), recording)) return kRefused;

  static RunResult result;
  result.seed = options.seed;
  result.config_hash = fnv1a_of_file(input.path.c_str(), fnv1a(session.text));
  for (; result.tracking_count < recording.tracking_count; ++result.tracking_count) {
    const auto i = static_cast<std::size_t>(result.tracking_count);
    result.tracking[i].start(recording.tracking[i]);
  }
  session.recorder.start(recording);
  const Row row = {
      "recorder", session.pipeline.recorder.divisor, 0,
      [](void* recorder, double time_s) { static_cast<Recorder*>(recorder)->record(time_s); },
      &session.recorder};
  if (session.executive.add(row) != Status::kOk) return kRefused;
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  execute(session, options, input, log, result);

  bool written = log.close();
  written &= write_summary(in_folder(folder, "summary.json").c_str(), pipeline, session, result);
  if (input.given() && recording.tracking_count > 0)
    written &= write_waypoints(in_folder(folder, "waypoints.csv").c_str(), input,
                               *recording.tracking[0].reference);
  print_table(pipeline, session, result);
  if (!written) std::fprintf(stderr, "%s: not everything could be written\n", folder.c_str());
  if (options.figure && written) draw_figure(folder.c_str());
  std::printf("  written to %s\n", folder.c_str());
  if (session.executive.telemetry().cycles == 0) return kRefused;
  return result.code == 0 && written ? kSucceeded : kEndedOtherwise;
}

}  // namespace tactus
