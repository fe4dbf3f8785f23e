#include "program/results/summary.hpp"

#include <cinttypes>
#include <cmath>
#include <cstdio>

#include "gateway/verdict_text.hpp"
#include "kernel/load/ini.hpp"
#include "program/results/json_string.hpp"
#include "program/results/result_file.hpp"
#include "program/results/run_log.hpp"
#include "program/results/timing_report.hpp"

namespace tactus {
namespace {

void write_numbers(std::FILE* file, const char* key, const TrackingError& error,
                   double (*number)(const TrackingError&, int)) {
  std::fprintf(file, ", \"%s\": [", key);
  for (int i = 0; i < error.components(); ++i) {
    const double value = number(error, i);
    std::fprintf(file, std::isfinite(value) ? "%s%.9g" : "%snull", i > 0 ? ", " : "", value);
  }
  std::fprintf(file, "]");
}

void write_overrides(std::FILE* file, const OverrideOptions& overrides) {
  std::fprintf(file, "  \"overrides\": [");
  for (int i = 0; i < overrides.count; ++i) {
    if (i > 0) std::fprintf(file, ", ");
    write_json_string(file, overrides.texts[i]);
  }
  std::fprintf(file, "],\n");
}

void write_tracking(std::FILE* file, const RunResult& result) {
  std::fprintf(file, "  \"tracking\": [");
  for (int i = 0; i < result.tracking_count; ++i) {
    const TrackingError& error = result.tracking[static_cast<std::size_t>(i)];
    const PortEntry &reference = *error.tracking().reference,
                    &measured = *error.tracking().measured;
    const QuantityInfo& quantity = info(reference.quantity);
    std::fprintf(file,
                 "%s\n    {\"signal\": \"%s.%s - %s.%s\", \"reference\": \"%s.%s\", "
                 "\"measured\": \"%s.%s\", ",
                 i > 0 ? "," : "", reference.block.c_str(), reference.port, measured.block.c_str(),
                 measured.port, reference.block.c_str(), reference.port, measured.block.c_str(),
                 measured.port);
    std::fprintf(file, "\"quantity\": \"%s\", \"unit\": \"%s\"", quantity.name, quantity.unit);
    write_numbers(file, "rms", error, [](const TrackingError& e, int c) { return e.rms(c); });
    write_numbers(file, "max", error, [](const TrackingError& e, int c) { return e.max(c); });
    write_numbers(file, "final", error, [](const TrackingError& e, int c) { return e.last(c); });
    std::fprintf(file, "}");
  }
  std::fprintf(file, "\n  ],\n");
}

/// Writes every recorded signal, the type of its block ("" for a section without a type) and its
/// columns in log.csv.
void write_signals(std::FILE* file, const Session& session) {
  static Ini ini;
  LoadError error;
  const bool parsed = ini.parse(session.text, error) == Status::kOk;
  const Recording& recording = session.pipeline.recording;
  std::fprintf(file, "  \"signals\": [");
  for (int i = 0; i < recording.signal_count; ++i) {
    const PortEntry& port = *recording.signals[static_cast<std::size_t>(i)];
    const QuantityInfo& quantity = info(port.quantity);
    const IniSection* section = parsed ? ini.find(port.block) : nullptr;
    const IniEntry* entry = section != nullptr ? ini.find(*section, "type") : nullptr;
    const std::string_view type = entry != nullptr ? entry->value : std::string_view();
    std::fprintf(file, "%s\n    {\"name\": \"%s.%s\", \"type\": \"%.*s\", ", i > 0 ? "," : "",
                 port.block.c_str(), port.port, static_cast<int>(type.size()), type.data());
    std::fprintf(file, "\"quantity\": \"%s\", \"unit\": \"%s\", \"columns\": [", quantity.name,
                 quantity.unit);
    for (int n = 0; n < quantity.recorded; ++n)
      std::fprintf(file, "%s\"%s\"", n > 0 ? ", " : "", column_name(port, n).c_str());
    std::fprintf(file, "]}");
  }
  std::fprintf(file, "\n  ],\n");
}

void write_wire(std::FILE* file, const Session& session) {
  if (session.counts == nullptr) return;
  const char* separator = "  \"wire\": {";
  for (const WireCount& count : session.counts()) {
    if (count.name == nullptr) break;
    std::fprintf(file, "%s\"%s\": ", separator, count.name);
    if (count.most < 0)
      std::fprintf(file, "%" PRId64, count.value);
    else
      std::fprintf(file, "[%" PRId64 ", %" PRId64 "]", count.value, count.most);
    separator = ", ";
  }
  std::fprintf(file, "},\n");
}

void print_wire(const Session& session) {
  if (session.counts == nullptr) return;
  const char* separator = "  wire: ";
  for (const WireCount& count : session.counts()) {
    if (count.name == nullptr) break;
    std::printf("%s%" PRId64, separator, count.value);
    if (count.most >= 0) std::printf(" to %" PRId64, count.most);
    std::printf(" %s", count.name);
    separator = ", ";
  }
  std::printf("\n");
}

double realtime_factor(const RunResult& result) {
  return result.wall_s > 0.0 ? result.simulated_s / result.wall_s : 0.0;
}

}  // namespace

bool write_summary(const char* path, std::string_view pipeline, const Session& session,
                   const RunResult& result) {
  ResultFile written;
  if (!written.open(path)) return false;
  std::FILE* const file = written.stream();
  const Executive::Telemetry& telemetry = session.executive.telemetry();
  const Guard::Telemetry& guard = session.executive.guard().telemetry();
  std::fprintf(file, "{\n  \"pipeline\": ");
  write_json_string(file, pipeline);
  std::fprintf(file, ",\n  \"robot\": \"%s\",\n  \"board\": \"%s\",\n  \"simulated\": %s,\n",
               Robot::kName, session.board, session.simulated ? "true" : "false");
  std::fprintf(file, "  \"rate_hz\": %.9g,\n  \"cycles\": %" PRId64 ",\n  \"seed\": %" PRIu64 ",\n",
               1.0 / session.pipeline.robot.period_s(), result.cycles, result.seed);
  write_overrides(file, *result.overrides);
  std::fprintf(file, "  \"config_hash\": \"%016" PRIx64 "\",\n", result.config_hash);
  std::fprintf(file, "  \"result\": {\"code\": %d, \"name\": \"%s\"", result.code, result.name);
  if (!result.why.empty()) {
    std::fprintf(file, ", \"why\": ");
    write_json_string(file, result.why);
  }
  std::fprintf(file, "},\n");
  result.expectation.write(file);
  std::fprintf(file, "  \"stretch\": %.4g,\n", result.stretch);
  std::fprintf(file, "  \"smoothed_rad\": %.4g,\n  \"smoothed_m\": %.4g,\n", result.moved.rad,
               result.moved.m);
  std::fprintf(file, "  \"starved\": %d,\n", result.starved);
  write_tracking(file, result);
  write_signals(file, session);
  write_timing(file, session.pipeline, session.executive);
  write_events(file, result.rung, session.executive.events(), session.hal,
               session.pipeline.robot.period_s());
  std::fprintf(file, "  \"slips\": %" PRIu32 ",\n  \"overruns\": %" PRIu32 ",\n",
               std::uint32_t{telemetry.slips}, std::uint32_t{telemetry.overruns});
  if (result.realtime.asked) write_realtime(file, result.realtime);
  write_wire(file, session);
  std::fprintf(file, "  \"guard\": {\"limited\": %u, \"tripped\": %d},\n", guard.limited_cycles,
               guard.tripped_joint >= 0 ? 1 : 0);
  std::fprintf(file, "  \"recorder_dropped\": %u,\n", session.recorder.dropped());
  std::fprintf(file, "  \"heap_allocations_in_cycle\": %" PRIu64 ",\n  \"static_bytes\": %zu,\n",
               result.heap_allocations, session.static_bytes);
  std::fprintf(file, "  \"realtime_factor\": %.4g\n}\n", realtime_factor(result));
  return written.close();
}

void print_table(std::string_view pipeline, const Session& session, const RunResult& result) {
  const Executive& executive = session.executive;
  const Message fault = describe(result.fault);
  std::printf("\n%.*s on %s, %.6g Hz: %s\n", static_cast<int>(pipeline.size()), pipeline.data(),
              session.board, 1.0 / session.pipeline.robot.period_s(),
              result.fault == Status::kOk ? result.name : fault.c_str());
  for (int i = 0; i < result.tracking_count; ++i) {
    const TrackingError& error = result.tracking[static_cast<std::size_t>(i)];
    const PortEntry &reference = *error.tracking().reference,
                    &measured = *error.tracking().measured;
    std::printf("\n  %s.%s - %s.%s (%s)\n  %9s %12s %12s %12s\n", reference.block.c_str(),
                reference.port, measured.block.c_str(), measured.port,
                info(reference.quantity).unit, "component", "rms", "max", "final");
    for (int c = 0; c < error.components(); ++c)
      std::printf("  %9d %12.3e %12.3e %12.3e\n", c + 1, error.rms(c), error.max(c), error.last(c));
  }
  result.expectation.print();
  print_timing(session.pipeline, executive);
  if (result.realtime.asked) print_realtime(result.realtime);
  print_events(executive.events(), session.hal, session.pipeline.robot.period_s());
  const Executive::Telemetry& telemetry = executive.telemetry();
  std::printf("\n  %" PRId64 " cycles, %" PRIu32 " slips, %" PRIu32 " overruns, rung %s, ",
              result.cycles, std::uint32_t{telemetry.slips}, std::uint32_t{telemetry.overruns},
              name(result.rung));
  std::printf("%u limited by the guard, %" PRIu64
              " heap allocations in cycles, %.3g s in %.3g s (%.0f x real time)\n",
              executive.guard().telemetry().limited_cycles, result.heap_allocations,
              result.simulated_s, result.wall_s, realtime_factor(result));
  print_wire(session);
}

}  // namespace tactus
