// `tactus jitter`: measures wake-up latency, optionally under load, and compares it with
// cyclictest.
#include <cinttypes>
#include <cmath>
#include <cstdio>

#include "gateway/verdict_text.hpp"
#include "hal/os/cycle_clock.hpp"
#include "program/host/cyclictest.hpp"
#include "program/host/doctor.hpp"
#include "program/host/load_generator.hpp"
#include "program/results/realtime_result.hpp"

namespace tactus {
namespace {

constexpr double kMeasurement_s = 5.0;

/// Two measurements of the same cycles on one host.
struct Measurement {
  Histogram ours, theirs;
  std::int64_t missed = 0;
  bool refused = false;   // the priority
  Text<127> complaint;    // why there is nothing by cyclictest
  bool compared = false;  // there is
};

RealtimeSettings settings_of(const Options& options) {
  RealtimeSettings settings;
  settings.priority = options.priority;
  settings.cpu = options.cpu;
  return settings;
}

/// Waits for one cycle after another and does nothing in between.
Status wait_for_cycles(int period_us, int cycles, Measurement& measurement) {
  CycleClock clock;
  Status status = clock.start(std::int64_t{1000} * period_us);
  for (int k = 0; k < cycles && status == Status::kOk; ++k) {
    Wake wake;
    status = clock.wait(wake);
    measurement.ours.add(static_cast<std::uint64_t>(wake.latency_ns()));
    measurement.missed += wake.missed;
  }
  return status;
}

/// Measures with the cycle clock, then with cyclictest.
Status measure(const Options& options, int cycles, Measurement& measurement) {
  Status status = Status::kOk;
  {
    Realtime realtime;  // released before a child process could inherit it
    const RealtimeReport& report = realtime.apply(settings_of(options));
    measurement.refused = report[RealtimeStage::kScheduler].outcome == StepOutcome::kRefused;
    status = wait_for_cycles(options.period_us, cycles, measurement);
  }
  if (status == Status::kOk)
    measurement.compared =
        run_cyclictest({options.period_us, cycles, options.priority, options.cpu},
                       measurement.theirs, measurement.complaint);
  return status;
}

/// Measures beside stress-ng. False: prints the reason to stderr.
bool measure_loaded(const Options& options, int cycles, Measurement& measurement, Status& status) {
  LoadGenerator generator;
  Text<127> complaint;
  if (generator.start(options.load, complaint)) {
    status = measure(options, cycles, measurement);
    if (generator.stop(complaint)) return true;
  }
  std::fprintf(stderr, "jitter: --load: %s\n", complaint.c_str());
  return false;
}

void print_row(const char* name, const Histogram& latency) {
  std::printf("  %-10s %9" PRIu32 " %9.1f %9.1f %9.1f %9.1f %9.1f %9.1f\n", name, latency.count(),
              static_cast<double>(latency.min()) * 1e-3, latency.mean() * 1e-3,
              latency.percentile(0.5) * 1e-3, latency.percentile(0.99) * 1e-3,
              latency.percentile(0.999) * 1e-3, static_cast<double>(latency.max()) * 1e-3);
}

void print(const Measurement& measurement) {
  std::printf("\n  %-10s %9s %9s %9s %9s %9s %9s %9s\n", "", "cycles", "min", "mean", "p50", "p99",
              "p99.9", "max");
  print_row("tactus", measurement.ours);
  if (measurement.compared) print_row("cyclictest", measurement.theirs);
  std::printf("\n  tactus missed %" PRId64 " periods\n", measurement.missed);
  if (!measurement.compared) std::printf("  cyclictest: %s\n", measurement.complaint.c_str());
}

}  // namespace

int jitter(const Options& options) {
  const double duration_s = options.duration_s > 0.0 ? options.duration_s : kMeasurement_s;
  const int cycles =
      static_cast<int>(std::fmax(1.0, std::fmin(1e9, duration_s * 1e6 / options.period_us)));
  static Measurement idle, loaded;
  Text<127> complaint;
  if (options.load.any() && !LoadGenerator::installed(complaint)) {
    std::fprintf(stderr, "jitter: --load: %s\n", complaint.c_str());
    return kRefused;
  }
  {
    Realtime realtime;  // reports once what is refused
    prepare(realtime, settings_of(options));
  }
  Status status = measure(options, cycles, idle);
  if (status == Status::kOk && options.load.any() &&
      !measure_loaded(options, cycles, loaded, status))
    return kEndedOtherwise;
  if (status != Status::kOk) {
    std::fprintf(stderr, "jitter: %s\n", describe(status).c_str());
    return kEndedOtherwise;
  }
  std::printf("Wake-up latency in us, period %d us, priority %d%s, measured in turn:\n",
              options.period_us, options.priority,
              idle.refused ? " (refused: measured without priority)" : "");
  print(idle);
  if (!options.load.any()) return kSucceeded;
  std::printf("\nThe same under load by stress-ng (%s):\n", names_of(options.load).c_str());
  print(loaded);
  return kSucceeded;
}

}  // namespace tactus
