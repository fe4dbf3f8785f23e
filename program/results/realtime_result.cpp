#include "program/results/realtime_result.hpp"

#include <cinttypes>
#include <cstring>

namespace tactus {

Complaint complain(const RealtimeReport& steps, const HostReport& host) {
  Complaint text;
  for (const RealtimeStep& step : steps.steps) {
    if (step.outcome != StepOutcome::kRefused) continue;
    text << (text.empty() ? "" : ", ") << step.name << " (";
    text << (step.error != 0 ? std::strerror(step.error) : "granted, but not in effect");
    text << ": " << step.remedy << ")";
  }
  for (const HostItem& item : host.items) {
    if (item.need != Need::kHost || item.finding == HostFinding::kOk) continue;
    text << (text.empty() ? "" : ", ") << item.name << " (" << item.value << ": " << item.remedy;
    text << ")";
  }
  return text;
}

/// Looks at the host first, since afterwards this thread holds up all others on its CPU.
bool prepare(Realtime& realtime, const RealtimeSettings& settings) {
  const HostReport host = inspect_host({"", settings.cpu, settings.priority});
  const Complaint text = complain(realtime.apply(settings), host);
  if (text.empty()) return true;
  const bool goes_on = settings.required == Required::kWarn;
  if (goes_on)
    std::fprintf(stderr, "note: real time is not certain: %s\n", text.c_str());
  else
    std::fprintf(stderr,
                 "real time: refused: %s; [realtime] required = refuse; with required = warn, on a "
                 "desk, the run goes on\n",
                 text.c_str());
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
    std::fprintf(file, "%s\"%s\": \"%s\"", separator, step.name, name(step.outcome));
    separator = ", ";
  }
  std::fprintf(file, "}\n  },\n");
}

/// Leaves out refused steps, which prepare() has printed.
void print_realtime(const RealtimeResult& result) {
  const Histogram& latency = result.latency;
  if (latency.count() > 0)  // none if the robot's clock begins the cycles
    std::printf("\n  %9s %12s %12s %12s %12s\n  %9s %12.2f %12.2f %12.2f %12.2f\n", "wake-up",
                "min us", "p50 us", "p99 us", "max us", "latency",
                static_cast<double>(latency.min()) * 1e-3, latency.percentile(0.5) * 1e-3,
                latency.percentile(0.99) * 1e-3, static_cast<double>(latency.max()) * 1e-3);
  std::printf("\n  real time:");
  for (const RealtimeStep& step : result.report.steps)
    if (step.outcome != StepOutcome::kRefused)
      std::printf(" %s %s,", step.name, name(step.outcome));
  std::printf(" %" PRId64 " page faults\n", result.page_faults);
}

}  // namespace tactus
