#include "program/results/timing_report.hpp"

#include <cinttypes>

#include "gateway/server/drive_text.hpp"
#include "gateway/verdict_text.hpp"
#include "kernel/core/names.hpp"
#include "program/results/json_string.hpp"

namespace tactus {
namespace {

using Label = Text<2 * kMaxNameLength>;

/// Calls visit(label, times, overruns) for every stage, block and row; overruns < 0: no budget.
template <class Visit>
void for_each_time(const Pipeline& pipeline, const Executive& executive, Visit visit) {
  const CycleTimes& timing = *executive.times();
  for (std::size_t i = 0; i < kNames<Stage>.size(); ++i) {
    visit(Label(kNames<Stage>[i]), timing.stage(static_cast<Stage>(i)), std::int64_t{-1});
    if (static_cast<Stage>(i) != Stage::kStep) continue;
    for (int block = 0; block < pipeline.count(); ++block)
      visit(Label("step.") << pipeline.name(block), timing.block(block), std::int64_t{-1});
  }
  for (int row = 0; row < pipeline.schedule.count(); ++row)
    visit(Label("row.") << pipeline.schedule[row].name, timing.row(row),
          std::int64_t{timing.row_overruns(row)});
}

}  // namespace

void write_timing(std::FILE* file, const Pipeline& pipeline, const Executive& executive) {
  const char* separator = "";
  std::fprintf(file, "  \"timing\": {");
  for_each_time(
      pipeline, executive, [&](const Label& label, const Histogram& t, std::int64_t over) {
        std::fprintf(file,
                     "%s\n    \"%s\": {\"p50_ns\": %.0f, \"p99_ns\": %.0f, \"max_ns\": %" PRIu32,
                     separator, label.c_str(), t.percentile(0.5), t.percentile(0.99), t.max());
        std::fprintf(file, ", \"p999_ns\": %.0f, \"p9999_ns\": %.0f", t.percentile(0.999),
                     t.percentile(0.9999));
        std::fprintf(file, ", \"min_ns\": %" PRIu32 ", \"mean_ns\": %.0f, \"count\": %" PRIu32,
                     t.min(), t.mean(), t.count());
        std::fprintf(file, ", \"saturated\": %" PRIu32, t.saturated());
        if (over >= 0) std::fprintf(file, ", \"overruns\": %" PRId64, over);
        std::fprintf(file, "}");
        separator = ",";
      });
  std::fprintf(file, "\n  },\n");
}

void write_events(std::FILE* file, Rung rung, const EventLog& events, const Hal& hal,
                  double period_s) {
  std::fprintf(file, "  \"rung\": \"%s\",\n  \"events_lost\": %" PRIu32 ",\n  \"events\": [",
               name(rung), events.lost());
  Event event;
  const char* separator = "";
  for (std::uint32_t i = events.lost(); events.read(i, event); ++i) {
    std::fprintf(file, "%s\n    {\"time_s\": %.9g", separator, event.commanded * period_s);
    std::fprintf(file, ", \"cause\": \"%s\", \"status\": \"%s\", \"from\": \"%s\", \"to\": \"%s\"",
                 name(event.cause), name(event.status), name(event.from), name(event.to));
    const auto value = static_cast<double>(event.value);
    std::fprintf(file, value - value == 0.0 ? ", \"value\": %.9g" : ", \"value\": null", value);
    std::fprintf(file, ", \"joint\": %d, \"code\": %" PRIu32, event.joint + 1, event.code);
    const Message of_drive = describe_drive(hal, event);
    if (!of_drive.empty()) std::fprintf(file, ", \"text\": ");
    if (!of_drive.empty()) write_json_string(file, of_drive);
    std::fprintf(file, "}");
    separator = ",";
  }
  std::fprintf(file, "\n  ],\n");
}

void print_timing(const Pipeline& pipeline, const Executive& executive) {
  std::printf("\n  %-20s %9s %9s %9s %9s %9s %9s %9s\n", "us", "min", "mean", "p50", "p99", "p99.9",
              "p99.99", "max");
  for_each_time(pipeline, executive, [](const Label& label, const Histogram& t, std::int64_t over) {
    if (t.count() == 0) return;
    std::printf("  %-20s %9.2f %9.2f %9.2f %9.2f %9.2f %9.2f %9.2f", label.c_str(), t.min() * 1e-3,
                t.mean() * 1e-3, t.percentile(0.5) * 1e-3, t.percentile(0.99) * 1e-3,
                t.percentile(0.999) * 1e-3, t.percentile(0.9999) * 1e-3, t.max() * 1e-3);
    if (over > 0) std::printf("  %" PRId64 " over budget", over);
    std::printf("\n");
  });
}

Message describe(const Event& event, const Hal& hal) {
  const Message of_drive = describe_drive(hal, event);
  if (!of_drive.empty() && event.from == event.to) return of_drive;
  Message text(name(event.from));
  text << " -> " << name(event.to) << ": " << name(event.cause) << ": ";
  text << describe(event.status).c_str();
  if (event.joint >= 0) text << ", joint " << event.joint + 1;
  return text << describe_code(hal, event.code).c_str();
}

void print_events(const EventLog& events, const Hal& hal, double period_s) {
  Event event;
  for (std::uint32_t i = events.lost(); events.read(i, event); ++i) {
    if (event.cause == Cause::kArm || event.cause == Cause::kRearm || event.cause == Cause::kOff)
      continue;
    std::printf("  %.3f s: %s\n", event.commanded * period_s, describe(event, hal).c_str());
  }
  if (events.lost() > 0)
    std::printf("  %" PRIu32 " earlier events are overwritten\n", events.lost());
}

}  // namespace tactus
