// Schedule: the rows that run in each cycle, and the check that they fit. A row runs in every cycle
// whose number is `offset` modulo `divisor`, and states the longest time it takes. The rows repeat
// after the major frame, the least common multiple of their divisors; in each of its minor frames,
// which are cycles, the budgets of the rows that run must fit the period. [Liu, Real-Time Systems,
// 2000, ch. 5: cyclic schedules; rate groups]
//
// The control chain is the first row. A schedule that is constant can be judged by static_assert.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "kernel/core/hal.hpp"
#include "kernel/core/status.hpp"

namespace tactus {

struct Row {
  /// Runs the row once, with the state measured in this cycle and the time since start, s. A result
  /// that is not kOk is a cause of the ladder. [cyclic]
  using Run = Status (*)(void* context, const RobotState& measured, double time_s);

  const char* name = "";
  int divisor = 1, offset = 0;
  int budget_us = 0;      ///< intended longest time
  bool optional = false;  ///< skipped while there are too many overruns
  Run run = nullptr;  ///< null: only its budget counts; "control" is run by the executive itself
  void* context = nullptr;

  constexpr bool due(std::int64_t cycle) const { return cycle % divisor == offset; }
};

inline constexpr int kMaxRows = 8;
inline constexpr std::int64_t kMaxMajorFrame = 100000;  ///< cycles

/// Why a schedule cannot be met.
struct ScheduleVerdict {
  Status status = Status::kOk;   ///< kBadValue: a row; kTooLarge: the major frame or the number of
                                 ///< rows; kOverBudget: a minor frame
  int row = -1;                  ///< the row of kBadValue
  std::int64_t major_frame = 1;  ///< cycles; of the rows checked
  std::int64_t frame = -1;       ///< the first minor frame that does not fit
  std::int64_t sum_us = 0;       ///< sum of the budgets in it
  constexpr bool ok() const { return status == Status::kOk; }
};

/// [any]
constexpr std::int64_t common_divisor(std::int64_t a, std::int64_t b) {
  while (b != 0) {  // Euclid: bounded by the digits of the smaller
    const std::int64_t rest = a % b;
    a = b;
    b = rest;
  }
  return a;
}

/// Judges the first `count` rows against a period. [init]
template <std::size_t N>
constexpr ScheduleVerdict judge(const std::array<Row, N>& rows, std::size_t count,
                                std::int64_t period_us) {
  ScheduleVerdict verdict;
  for (std::size_t i = 0; i < count; ++i) {
    const Row& row = rows[i];
    const bool runs = row.divisor >= 1 && row.offset >= 0 && row.offset < row.divisor;
    if (!runs || row.budget_us < 1) return {Status::kBadValue, static_cast<int>(i)};
    verdict.major_frame *= row.divisor / common_divisor(verdict.major_frame, row.divisor);
    if (verdict.major_frame > kMaxMajorFrame) return {Status::kTooLarge, -1, verdict.major_frame};
  }
  for (std::int64_t frame = 0; frame < verdict.major_frame; ++frame) {
    std::int64_t sum_us = 0;
    for (std::size_t i = 0; i < count; ++i)
      if (rows[i].due(frame)) sum_us += rows[i].budget_us;
    if (sum_us > period_us) return {Status::kOverBudget, -1, verdict.major_frame, frame, sum_us};
  }
  return verdict;
}

template <std::size_t N>
constexpr ScheduleVerdict judge(const std::array<Row, N>& rows, std::int64_t period_us) {
  return judge(rows, N, period_us);
}

class Schedule {
 public:
  /// Appends a row. Refused, without effect, if there is no place or not all rows can be met.
  /// [init]
  [[gnu::cold]] ScheduleVerdict add(const Row& row, std::int64_t period_us);
  /// Sets the function of the row called `name`; false if there is none. [init]
  bool bind(std::string_view name, Row::Run run, void* context);

  int count() const { return static_cast<int>(count_); }
  const Row& operator[](int index) const { return rows_[static_cast<std::size_t>(index)]; }

 private:
  std::array<Row, kMaxRows> rows_;
  std::size_t count_ = 0;
};

}  // namespace tactus
