#include "kernel/load/schedule_reader.hpp"

namespace tactus {
namespace {

/// Refuses a row at the line of `key` in the row's own section.
struct RowPlace {
  const Ini& ini;
  LoadError& error;

  Status refuse(Status status, const char* section, const char* key, std::string_view why) const {
    const IniSection* found = ini.find(section);
    const IniEntry* entry = found ? ini.find(*found, key) : nullptr;
    return error.refuse(status, entry ? entry->line : found ? found->line : 0, section, key, why);
  }
};

Message number(std::int64_t value) {
  return Message("") << static_cast<int>(value);
}

/// "frame 3 of 10: control 900 + recorder 200 = 1100 us, more than the period of 1000 us".
Message overflow(const Schedule& schedule, const Row& last, const ScheduleVerdict& verdict,
                 int period_us) {
  Message text("frame ");
  text << number(verdict.frame) << " of " << number(verdict.major_frame) << ":";
  for (int i = 0; i <= schedule.count(); ++i) {
    const Row& row = i < schedule.count() ? schedule[i] : last;
    if (row.due(verdict.frame)) text << (i > 0 ? " + " : " ") << row.name << " " << row.budget_us;
  }
  text << " = " << number(verdict.sum_us) << " us, more than the period of " << period_us << " us";
  return text;
}

Status add(Pipeline& pipeline, const Row& row, const char* section, const RowPlace& place) {
  const int period_us = pipeline.robot.period_us;
  const ScheduleVerdict verdict = pipeline.schedule.add(row, period_us);
  switch (verdict.status) {
    case Status::kOk: return Status::kOk;
    case Status::kOverBudget:
      return place.refuse(verdict.status, section, "budget_us",
                          overflow(pipeline.schedule, row, verdict, period_us));
    case Status::kBadValue:
      return place.refuse(
          verdict.status, section, "offset",
          Message("") << row.offset << " cycles is out of range; it must be less than the divisor, "
                      << row.divisor);
    default:
      return place.refuse(verdict.status, section, "divisor",
                          Message("the rows repeat only after more than ")
                              << number(kMaxMajorFrame) << " cycles, or there are more than "
                              << kMaxRows << " rows");
  }
}

/// Refuses a stop or an arming that would be given up before the arm can be at rest.
Status check_rest(const Pipeline& pipeline, const RowPlace& place) {
  const ExecutiveSection& settings = pipeline.executive;
  const int period_us = pipeline.robot.period_us;
  const int rest_ms =
      settings.rest_blocks(period_us) * ExecutiveSection::kRestBlock * period_us / 1000;
  const bool arms = settings.arming_ms > rest_ms;
  const int longest_ms = arms ? settings.stop_ms : settings.arming_ms;
  if (longest_ms > rest_ms) return Status::kOk;
  return place.refuse(Status::kBadValue, "executive", arms ? "stop_ms" : "arming_ms",
                      Message("") << longest_ms << " ms; it must be more than " << rest_ms
                                  << " ms: rest_ms in whole blocks of 10 cycles");
}

Status check_collision(void* collision, const RobotState& measured, double) {
  return static_cast<Collision*>(collision)->step(measured);
}

}  // namespace

Status read_schedule(const Ini& ini, Pipeline& pipeline, LoadError& error) {
  const RowPlace place{ini, error};
  TRY(check_rest(pipeline, place));
  const RecorderSection& recorder = pipeline.recorder;
  const int budget_us = pipeline.executive.budget(pipeline.robot.period_us);
  TRY(add(pipeline, {"control", 1, 0, budget_us}, "executive", place));
  // The board owns the recorder's ring and binds this row.
  TRY(add(pipeline, {"recorder", recorder.divisor, recorder.offset, recorder.budget_us, true},
          "recorder", place));
  if (ini.find("collision") == nullptr) return Status::kOk;
  const CollisionSection& collision = pipeline.collision;
  return add(
      pipeline,
      {"collision", 1, 0, collision.budget_us, false, check_collision, &pipeline.collision_check},
      "collision", place);
}

}  // namespace tactus
