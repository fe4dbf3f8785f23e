#include "kernel/pipeline/schedule.hpp"

namespace tactus {

ScheduleVerdict Schedule::add(const Row& row, std::int64_t period_us) {
  if (count_ == rows_.size()) return {Status::kTooLarge};
  rows_[count_] = row;
  const ScheduleVerdict verdict = judge(rows_, count_ + 1, period_us);
  if (verdict.ok()) ++count_;
  return verdict;
}

bool Schedule::bind(std::string_view name, Row::Run run, void* context) {
  for (std::size_t i = 0; i < count_; ++i) {
    if (rows_[i].name != name) continue;
    rows_[i].run = run;
    rows_[i].context = context;
    return true;
  }
  return false;
}

}  // namespace tactus
