// Tests the degrade ladder: every cell of its table against the table of docs/executive.md, which
// is written by hand, the watches that detect its causes, and the log of its events.
#include "kernel/cycle/ladder.hpp"

#include <cstdio>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "kernel/cycle/event_log.hpp"
#include "kernel/pipeline/rate_watch.hpp"
#include "tests/reference/generator/reference_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr CommandMode kModes[] = {CommandMode::kPosition, CommandMode::kVelocity,
                                  CommandMode::kEffort};

/// Returns the line of a table in docs/executive.md that begins with `first`, or "".
std::string documented(const char* first) {
  static char line[1024];
  std::FILE* file = std::fopen("docs/executive.md", "r");
  assert_non_null(file);
  const std::string start = std::string("| `") + first + "` |";
  std::string found;
  while (found.empty() && std::fgets(line, sizeof line, file) != nullptr)
    if (std::strncmp(line, start.c_str(), start.size()) == 0) found = line;
  std::fclose(file);
  return found;
}

// Proves LAD-1, LAD-13.

void every_cell_of_the_table_is_as_documented(void**) {
  for (std::size_t c = 0; c < kCauses; ++c) {
    const auto cause = static_cast<Cause>(c);
    const std::string line = documented(name(cause));
    std::string expected = std::string("| `") + name(cause) + "` |";
    for (std::size_t r = 0; r < kRungs; ++r)
      expected +=
          std::string(" ") + name(next(static_cast<Rung>(r), cause, CommandMode::kPosition)) + " |";
    expected += rule(cause).chain ? " yes |" : " no |";
    expected += rule(cause).way == BrakeWay::kAtOnce ? " at once |" : " on path |";
    if (line.compare(0, expected.size(), expected) != 0)
      print_error("docs/executive.md: expected\n%s\nfound\n%s\n", expected.c_str(), line.c_str());
    assert_true(line.compare(0, expected.size(), expected) == 0);
  }
}

void positions_and_velocities_go_the_same_way(void**) {
  for (std::size_t c = 0; c < kCauses; ++c)
    for (std::size_t r = 0; r < kRungs; ++r)
      assert_true(next(static_cast<Rung>(r), static_cast<Cause>(c), CommandMode::kPosition) ==
                  next(static_cast<Rung>(r), static_cast<Cause>(c), CommandMode::kVelocity));
}

void efforts_without_a_chain_are_disabled_and_go_the_same_way_with_one(void**) {
  for (std::size_t c = 0; c < kCauses; ++c) {
    for (std::size_t r = 0; r < kRungs; ++r) {
      const auto cause = static_cast<Cause>(c);
      const auto rung = static_cast<Rung>(r);
      const bool lost = cause == Cause::kSensor || cause == Cause::kStage ||
                        cause == Cause::kCommand || cause == Cause::kState ||
                        cause == Cause::kWire || cause == Cause::kDrive;
      assert_true(next(rung, cause, CommandMode::kEffort) ==
                  (lost ? Rung::kDisabled : next(rung, cause, CommandMode::kPosition)));
    }
  }
}

void only_arming_leads_up_but_for_optional_rows(void**) {
  for (const CommandMode mode : kModes) {
    for (std::size_t c = 0; c < kCauses; ++c) {
      for (std::size_t r = 0; r < kRungs; ++r) {
        const auto cause = static_cast<Cause>(c);
        const auto rung = static_cast<Rung>(r);
        const bool cleaned = cause == Cause::kClean && rung == Rung::kSkipOptional;
        const bool taken_over =
            cause == Cause::kRearm && (rung == Rung::kHold || rung == Rung::kArming);
        const bool asked = cause == Cause::kArm && rung == Rung::kDisabled;
        const Rung to = next(rung, cause, mode);
        if (cleaned || taken_over)
          assert_true(to == Rung::kNominal);
        else if (asked)
          assert_true(to == Rung::kArming);
        else
          assert_true(to >= rung);
      }
    }
  }
}

// Proves LAD-2.

void overruns_are_too_many_as_counting_the_window_says(void**) {
  Random random{7};
  for (int trial = 0; trial < 300; ++trial) {
    const int allowed = random.below(RateWatch::kMost + 1), window = 1 + random.below(40);
    const int clean = 1 + random.below(20);
    const double often = random.uniform(0.0, 1.0);
    RateWatch watch;
    watch.start(allowed, window, clean);
    std::vector<int> overruns;  // since counting began
    int quiet = 0;
    for (int cycle = 0; cycle < 200; ++cycle) {
      const bool overrun = random.uniform(0.0, 1.0) < often;
      RateWatch::Result expected = RateWatch::Result::kNothing;
      if (overrun) {
        quiet = 0;
        overruns.push_back(cycle);
        int within = 0;
        for (const int at : overruns) within += at > cycle - window ? 1 : 0;
        if (within > allowed) {
          expected = RateWatch::Result::kTooMany;
          overruns.clear();
        }
      } else if (++quiet % clean == 0) {
        expected = RateWatch::Result::kClean;
      }
      assert_true(watch.add(overrun) == expected);
    }
  }
}

// Proves LAD-8.

Event numbered(std::uint32_t i) {
  return {std::int64_t{1} << 40 | i,
          i,
          3 * i,
          static_cast<float>(i),
          7 * i,
          Status::kSlip,
          Cause::kSlip,
          Rung::kNominal,
          Rung::kHold,
          static_cast<std::int8_t>(i % 7)};
}

bool is(const Event& event, std::uint32_t i) {
  return event.stamp_ns == (std::int64_t{1} << 40 | i) && event.cycle == i &&
         event.commanded == 3 * i && event.value == static_cast<float>(i) && event.code == 7 * i &&
         event.joint == static_cast<int>(i % 7) && event.status == Status::kSlip &&
         event.from == Rung::kNominal && event.to == Rung::kHold;
}

void the_log_keeps_the_newest_and_counts_the_lost(void**) {
  EventLog log;
  Event event;
  assert_false(log.read(0, event));
  for (std::uint32_t i = 0; i < 100; ++i) {
    log.add(numbered(i));
    const std::uint32_t lost = i < EventLog::kCapacity ? 0 : i + 1 - EventLog::kCapacity;
    assert_int_equal(log.count(), i + 1);
    assert_int_equal(log.lost(), lost);
    for (std::uint32_t k = 0; k < 102; ++k)
      assert_true(log.read(k, event) == (k >= lost && k <= i) &&
                  (k < lost || k > i || is(event, k)));
  }
}

void a_reader_in_another_thread_gets_whole_events_or_none(void**) {
  static EventLog log;
  constexpr std::uint32_t kEvents = 100000;
  std::thread writer([] {
    for (std::uint32_t i = 0; i < kEvents; ++i) log.add(numbered(i));
  });
  bool whole = true;
  for (std::uint32_t count = 0; count < kEvents;) {
    count = log.count();
    Event event;
    for (std::uint32_t k = log.lost(); k < count; ++k)
      if (log.read(k, event)) whole = whole && is(event, k);
  }
  writer.join();
  assert_true(whole);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_cell_of_the_table_is_as_documented),
      cmocka_unit_test(positions_and_velocities_go_the_same_way),
      cmocka_unit_test(efforts_without_a_chain_are_disabled_and_go_the_same_way_with_one),
      cmocka_unit_test(only_arming_leads_up_but_for_optional_rows),
      cmocka_unit_test(overruns_are_too_many_as_counting_the_window_says),
      cmocka_unit_test(the_log_keeps_the_newest_and_counts_the_lost),
      cmocka_unit_test(a_reader_in_another_thread_gets_whole_events_or_none),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
