// `tactus jitter`.
#include <cinttypes>
#include <cmath>
#include <cstdio>

#include "boards/program/cyclictest.hpp"
#include "boards/program/doctor.hpp"
#include "boards/program/realtime_result.hpp"
#include "hal/os/cycle_clock.hpp"

namespace tactus {
namespace {

constexpr double kDefaultDuration_s = 5.0;

/// Only waits, cycle after cycle; nothing else is done in between.
Status measure(int period_us, int cycles, Histogram& latency, std::int64_t& missed) {
  CycleClock clock;
  Status status = clock.start(std::int64_t{1000} * period_us);
  for (int k = 0; k < cycles && status == Status::kOk; ++k) {
    Wake wake;
    status = clock.wait(wake);
    latency.add(static_cast<std::uint64_t>(wake.latency_ns()));
    missed += wake.missed;
  }
  return status;
}

void print_row(const char* name, const Histogram& latency) {
  std::printf("  %-10s %9" PRIu32 " %9.1f %9.1f %9.1f %9.1f %9.1f %9.1f\n", name, latency.count(),
              static_cast<double>(latency.min()) * 1e-3, latency.mean() * 1e-3,
              latency.percentile(0.5) * 1e-3, latency.percentile(0.99) * 1e-3,
              latency.percentile(0.999) * 1e-3, static_cast<double>(latency.max()) * 1e-3);
}

}  // namespace

int jitter(const Options& options) {
  const double duration_s = options.duration_s > 0.0 ? options.duration_s : kDefaultDuration_s;
  const int cycles =
      static_cast<int>(std::fmax(1.0, std::fmin(1e9, duration_s * 1e6 / options.period_us)));
  RealtimeSettings settings;
  settings.priority = options.priority;
  settings.cpu = options.cpu;
  static Histogram ours, theirs;
  std::int64_t missed = 0;
  Status status = Status::kOk;
  bool refused = false;
  {
    Realtime realtime;  // given back before the child inherits it
    prepare(realtime, settings);
    refused = realtime.report()[RealtimeStage::kScheduler].outcome == StepOutcome::kRefused;
    status = measure(options.period_us, cycles, ours, missed);
  }
  if (status != Status::kOk) {
    std::fprintf(stderr, "jitter: %s\n", name(status));
    return kEndedOtherwise;
  }
  Text<127> complaint;
  const bool compared =
      run_cyclictest({options.period_us, cycles, options.priority, options.cpu}, theirs, complaint);
  std::printf("Wake-up latency in us, period %d us, priority %d%s, one after the other:\n\n",
              options.period_us, options.priority, refused ? " (refused: measured without)" : "");
  std::printf("  %-10s %9s %9s %9s %9s %9s %9s %9s\n", "", "cycles", "min", "mean", "p50", "p99",
              "p99.9", "max");
  print_row("tactus", ours);
  if (compared) print_row("cyclictest", theirs);
  std::printf("\n  %" PRId64 " periods missed by tactus\n", missed);
  if (!compared) std::printf("  cyclictest: %s\n", complaint.c_str());
  return kSucceeded;
}

}  // namespace tactus
