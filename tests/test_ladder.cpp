// The degrade ladder: every cell of its table against the table of docs/executive.md, which is
// typed by hand; the watches that find its causes; the log of its events.
#include "kernel/ladder.hpp"

#include <cstdio>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "kernel/event_log.hpp"
#include "kernel/overrun_watch.hpp"
#include "kernel/rest_watch.hpp"
#include "tests/reference_bench.hpp"
#include "tests/testing.hpp"

namespace tactus {
namespace {

constexpr CommandMode kModes[] = {CommandMode::kPosition, CommandMode::kVelocity,
                                  CommandMode::kEffort};

/// The line of a table in docs/executive.md that begins with `first`; "" if there is none.
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
                        cause == Cause::kCommand || cause == Cause::kState || cause == Cause::kWire;
      assert_true(next(rung, cause, CommandMode::kEffort) ==
                  (lost ? Rung::kDisabled : next(rung, cause, CommandMode::kPosition)));
    }
  }
}

void only_a_rearm_leads_up_but_for_optional_rows(void**) {
  for (const CommandMode mode : kModes) {
    for (std::size_t c = 0; c < kCauses; ++c) {
      for (std::size_t r = 0; r < kRungs; ++r) {
        const auto cause = static_cast<Cause>(c);
        const auto rung = static_cast<Rung>(r);
        if (cause == Cause::kRearm) continue;
        const bool cleaned = cause == Cause::kClean && rung == Rung::kSkipOptional;
        assert_true(cleaned ? next(rung, cause, mode) == Rung::kNominal
                            : next(rung, cause, mode) >= rung);
      }
    }
  }
}

// Proves LAD-2.

void overruns_are_too_many_as_counting_the_window_says(void**) {
  Random random{7};
  for (int trial = 0; trial < 300; ++trial) {
    const int allowed = random.below(OverrunWatch::kMost + 1), window = 1 + random.below(40);
    const int clean = 1 + random.below(20);
    const double often = random.uniform(0.0, 1.0);
    OverrunWatch watch;
    watch.start(allowed, window, clean);
    std::vector<int> overruns;  // since counting began
    int quiet = 0;
    for (int cycle = 0; cycle < 200; ++cycle) {
      const bool overrun = random.uniform(0.0, 1.0) < often;
      OverrunWatch::Found expected = OverrunWatch::Found::kNothing;
      if (overrun) {
        quiet = 0;
        overruns.push_back(cycle);
        int within = 0;
        for (const int at : overruns) within += at > cycle - window ? 1 : 0;
        if (within > allowed) expected = OverrunWatch::Found::kTooMany, overruns.clear();
      } else if (++quiet % clean == 0) {
        expected = OverrunWatch::Found::kClean;
      }
      assert_true(watch.add(overrun) == expected);
    }
  }
}

// Proves LAD-4.

void rest_is_ten_cycles_of_no_joint_moving_and_is_told_once(void**) {
  RestWatch watch;
  watch.start(100);
  JointVector dq = JointVector::Zero();
  for (int i = 1; i < 10; ++i) assert_true(watch.add(dq, 0.01) == RestWatch::Found::kNothing);
  dq[kDof - 1] = -0.011;  // one joint moves again
  assert_true(watch.add(dq, 0.01) == RestWatch::Found::kNothing);
  dq[kDof - 1] = 0.01;
  for (int i = 1; i < 10; ++i) assert_true(watch.add(dq, 0.01) == RestWatch::Found::kNothing);
  assert_false(watch.at_rest());
  assert_true(watch.add(dq, 0.01) == RestWatch::Found::kAtRest);
  assert_true(watch.at_rest());
  for (int i = 0; i < 200; ++i) assert_true(watch.add(dq, 0.01) == RestWatch::Found::kNothing);
}

void a_brake_that_takes_too_long_is_told_once_and_a_velocity_that_is_no_number_is_no_rest(void**) {
  RestWatch watch;
  watch.start(50);
  const JointVector dq = JointVector::Constant(std::nan(""));
  for (int i = 1; i < 50; ++i) assert_true(watch.add(dq, 0.01) == RestWatch::Found::kNothing);
  assert_true(watch.add(dq, 0.01) == RestWatch::Found::kTooLong);
  assert_true(watch.add(dq, 0.01) == RestWatch::Found::kNothing);
  assert_false(watch.at_rest());
}

// Proves LAD-8.

Event numbered(std::uint32_t i) {
  return {std::int64_t{1} << 40 | i,
          i,
          static_cast<float>(i),
          Status::kSlip,
          Cause::kSlip,
          Rung::kNominal,
          Rung::kHold,
          static_cast<std::int8_t>(i % 7)};
}

bool is(const Event& event, std::uint32_t i) {
  return event.stamp_ns == (std::int64_t{1} << 40 | i) && event.cycle == i &&
         event.value == static_cast<float>(i) && event.joint == static_cast<int>(i % 7) &&
         event.status == Status::kSlip && event.from == Rung::kNominal && event.to == Rung::kHold;
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
  log.clear();
  assert_false(log.read(0, event) || log.count() > 0);
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
      cmocka_unit_test(only_a_rearm_leads_up_but_for_optional_rows),
      cmocka_unit_test(overruns_are_too_many_as_counting_the_window_says),
      cmocka_unit_test(rest_is_ten_cycles_of_no_joint_moving_and_is_told_once),
      cmocka_unit_test(
          a_brake_that_takes_too_long_is_told_once_and_a_velocity_that_is_no_number_is_no_rest),
      cmocka_unit_test(the_log_keeps_the_newest_and_counts_the_lost),
      cmocka_unit_test(a_reader_in_another_thread_gets_whole_events_or_none),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
