#include "boards/program/realtime_result.hpp"

#include <cinttypes>
#include <cstring>

namespace tactus {

bool prepare(Realtime& realtime, const RealtimeSettings& settings) {
  const RealtimeReport& report = realtime.apply(settings);
  for (const RealtimeStep& step : report.steps) {
    if (step.outcome != StepOutcome::kRefused) continue;
    std::fprintf(stderr, "real time: %s: refused: %s; %s\n", step.name,
                 step.error != 0 ? std::strerror(step.error) : "granted, but not in effect",
                 step.remedy);
  }
  if (!report.refused() || settings.required == Required::kWarn) return true;
  std::fprintf(stderr, "real time: refused: [realtime] required = refuse\n");
  return false;
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

void print_realtime(const RealtimeResult& result) {
  const Histogram& latency = result.latency;
  std::printf("\n  %9s %12s %12s %12s %12s\n  %9s %12.2f %12.2f %12.2f %12.2f\n", "wake-up",
              "min us", "p50 us", "p99 us", "max us", "latency",
              static_cast<double>(latency.min()) * 1e-3, latency.percentile(0.5) * 1e-3,
              latency.percentile(0.99) * 1e-3, static_cast<double>(latency.max()) * 1e-3);
  std::printf("\n  real time:");
  for (const RealtimeStep& step : result.report.steps)
    std::printf(" %s %s,", step.name, kStepOutcomeWords[static_cast<std::size_t>(step.outcome)]);
  std::printf(" %" PRId64 " page faults\n", result.page_faults);
}

}  // namespace tactus
