#include "boards/program/realtime_result.hpp"

#include <cinttypes>
#include <cstring>

namespace tactus {

/// One line for all that could not be had. It is a note where the pipeline file goes on without.
bool prepare(Realtime& realtime, const RealtimeSettings& settings) {
  const RealtimeReport& report = realtime.apply(settings);
  if (!report.refused()) return true;
  const bool goes_on = settings.required == Required::kWarn;
  std::fprintf(stderr, goes_on ? "note: real time without" : "real time: refused:");
  const char* separator = " ";
  for (const RealtimeStep& step : report.steps) {
    if (step.outcome != StepOutcome::kRefused) continue;
    std::fprintf(stderr, "%s%s (%s: %s)", separator, step.name,
                 step.error != 0 ? std::strerror(step.error) : "granted, but not in effect",
                 step.remedy);
    separator = ", ";
  }
  std::fprintf(stderr, goes_on ? "\n" : "; [realtime] required = refuse\n");
  return goes_on;
}

void write_realtime(std::FILE* file, const RealtimeResult& result) {
  const Histogram& latency = result.latency;
  std::fprintf(file, "  \"realtime\": {\n    \"latency\": {\"min_ns\": %" PRIu32, latency.min());
  std::fprintf(file, ", \"p50_ns\": %.0f, \"p99_ns\": %.0f, \"max_ns\": %" PRIu32 "},\n",
               latency.percentile(0.5), latency.percentile(0.99), latency.max());
  std::fprintf(file, "    \"page_faults\": %" PRId64 ",\n    \"steps\": {", result.page_faults);
  const char* separator = "";
  for (const RealtimeStep& step : result.report.steps) {
    std::fprintf(file, "%s\"%s\": \"%s\"", separator, step.name,
                 kStepOutcomeWords[static_cast<std::size_t>(step.outcome)]);
    separator = ", ";
  }
  std::fprintf(file, "}\n  },\n");
}

/// What was refused the note has said.
void print_realtime(const RealtimeResult& result) {
  const Histogram& latency = result.latency;
  if (latency.count() > 0)  // the robot's own clock has none to tell
    std::printf("\n  %9s %12s %12s %12s %12s\n  %9s %12.2f %12.2f %12.2f %12.2f\n", "wake-up",
                "min us", "p50 us", "p99 us", "max us", "latency",
                static_cast<double>(latency.min()) * 1e-3, latency.percentile(0.5) * 1e-3,
                latency.percentile(0.99) * 1e-3, static_cast<double>(latency.max()) * 1e-3);
  std::printf("\n  real time:");
  for (const RealtimeStep& step : result.report.steps)
    if (step.outcome != StepOutcome::kRefused)
      std::printf(" %s %s,", step.name, kStepOutcomeWords[static_cast<std::size_t>(step.outcome)]);
  std::printf(" %" PRId64 " page faults\n", result.page_faults);
}

}  // namespace tactus
