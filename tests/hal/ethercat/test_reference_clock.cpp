// Frames with old or wrong contents, told by the time of the segment that comes with them.
#include <random>

#include "tests/hal/ethercat/fault_bench.hpp"

namespace tactus::ethercat {
namespace {

using Verdict = ReferenceClock::Verdict;

constexpr std::int64_t kPeriod_ns = 1'000'000, kSlack_ns = 4 * kPeriod_ns;
constexpr std::size_t kClock = 1;  // its place in the frame of a cycle

/// The datagrams of a frame of a cycle; none of any other frame.
int datagrams_of(Frame& frame, std::array<Datagram, 4>& list) {
  FrameReader reader(frame);
  int count = 0;
  while (count < 4 && reader.next(list[static_cast<std::size_t>(count)])) ++count;
  return count > 2 && list[0].command == Command::kLrw ? count : 0;
}

/// A man in the middle: repeats what one frame had, with the index of every new one.
class Replay {
 public:
  explicit Replay(std::array<bool, 3> places) : places_(places) {}

  void operator()(Frame& frame) {
    std::array<Datagram, 4> list;
    if (datagrams_of(frame, list) == 0) return;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!places_[i]) continue;
      const Datagram& datagram = list[i];
      if (!known_) std::memcpy(old_[i].data(), datagram.data, datagram.size + kCounterBytes);
      std::memcpy(datagram.data, old_[i].data(), datagram.size + kCounterBytes);
    }
    known_ = true;
  }

 private:
  std::array<bool, 3> places_;
  bool known_ = false;
  std::array<std::array<std::uint8_t, kMaxFrame>, 3> old_{};
};

/// Writes the time, and takes the working counter of the clock's datagram.
template <class Time>
auto clock_of(Time time, int counter = -1) {
  return [time, counter](Frame& frame) mutable {
    std::array<Datagram, 4> list;
    if (datagrams_of(frame, list) == 0) return;
    const Datagram& clock = list[kClock];
    put(clock.data, time(get<std::int64_t>(clock.data)));
    if (counter >= 0) clock.set_counter(static_cast<std::uint16_t>(counter));
  };
}

// Proves ECAT-14.
void a_time_must_go_on_and_by_no_more_than_has_passed(void**) {
  ReferenceClock clock;
  clock.start(true, kSlack_ns);
  std::int64_t now_ns = 5'000'000, time_ns = INT64_MAX - kPeriod_ns / 2;
  const auto take = [&](std::int64_t passed_ns) {
    now_ns += kPeriod_ns;
    const auto shown = static_cast<std::int64_t>(static_cast<std::uint64_t>(time_ns) +
                                                 static_cast<std::uint64_t>(passed_ns));
    const Verdict verdict = clock.take(shown, now_ns - kPeriod_ns, now_ns);
    if (verdict == Verdict::kRuns) time_ns = shown;
    return verdict;
  };
  assert_true(take(0) == Verdict::kRuns);  // the first
  assert_true(take(kPeriod_ns) == Verdict::kRuns);
  assert_true(time_ns < 0);  // beyond the largest number
  assert_true(take(0) == Verdict::kStands);
  assert_true(take(-1) == Verdict::kJumps);
  assert_true(take(4 * kPeriod_ns + kSlack_ns + 1) == Verdict::kJumps);
  assert_true(take(5 * kPeriod_ns + kSlack_ns) == Verdict::kRuns);
  assert_true(take(1) == Verdict::kRuns);
  assert_true(take(INT64_MAX) == Verdict::kJumps);
}

/// After a stall of the computer the frame shows a time in which it was under way.
void a_stall_of_the_computer_is_no_jump(void**) {
  ReferenceClock clock;
  clock.start(true, kSlack_ns);
  assert_true(clock.take(0, 0, 100 * kPeriod_ns) == Verdict::kRuns);
  assert_true(clock.take(100 * kPeriod_ns, 100 * kPeriod_ns, 101 * kPeriod_ns) == Verdict::kRuns);
}

void a_clock_of_32_bits_goes_on_where_it_wraps(void**) {
  ReferenceClock clock;
  clock.start(false, kSlack_ns);
  assert_true(clock.take(0xFFFFFFF0, 0, kPeriod_ns) == Verdict::kRuns);
  assert_true(clock.take(0x10, kPeriod_ns, 2 * kPeriod_ns) == Verdict::kRuns);
  assert_true(clock.time_ns() == 0x100000010);
  assert_true(clock.take(0x10, 2 * kPeriod_ns, 3 * kPeriod_ns) == Verdict::kStands);
  assert_true(clock.take(0xFFFFFFF0, 3 * kPeriod_ns, 4 * kPeriod_ns) == Verdict::kJumps);
}

MasterBench& following() {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycles(20));
  return bench;
}
void assert_stopped(MasterBench& bench, const char* words) {
  Status status = Status::kOk;
  for (int i = 0; i < 6; ++i) status = bench.cycle();
  ASSERT_STATUS(status, Status::kBusTimeout);
  assert_false(enables(bench));
  assert_false(pushes(bench));
  const Message said = bench.hal.trouble();
  if (std::strstr(said.c_str(), words) == nullptr) print_error("%s\n", said.c_str());
  assert_non_null(std::strstr(said.c_str(), words));
}

void frozen_feedback_is_not_followed(void**) {
  for (const bool wait : {false, true}) {
    MasterBench& bench = fresh_bench();
    bench.ethercat.frame_wait_ms = wait ? 200 : 0;
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.start());
    ASSERT_OK(bench.cycles(20));
    bench.hal.tamper = Replay({true, true, true});
    assert_stopped(bench, "the clock of slave 1 (0910h) stands still");
  }
}

void a_time_that_goes_back_or_far_ahead_is_no_feedback(void**) {
  MasterBench& back = following();
  back.hal.tamper = clock_of([](std::int64_t time) { return time - 1'000'000'000; });
  assert_stopped(back, "the clock of slave 1 (0910h) jumps");
  MasterBench& ahead = following();
  ahead.hal.tamper = clock_of([](std::int64_t time) { return time + 1'000'000'000; });
  assert_stopped(ahead, "the clock of slave 1 (0910h) jumps");
}

void a_clock_that_is_not_read_is_a_wrong_working_counter(void**) {
  MasterBench& bench = following();
  bench.hal.tamper = clock_of([](std::int64_t) { return std::int64_t{0}; }, 0);
  assert_stopped(bench, "no feedback in more cycles");
  assert_in_range(bench.hal.master.counts().counter, 4, 6);
}

void a_few_old_frames_are_bridged(void**) {
  MasterBench& bench = following();
  bench.hal.tamper = Replay({true, true, true});
  ASSERT_OK(bench.cycles(bench.drive.max_missed));
  bench.hal.tamper = {};
  ASSERT_OK(bench.cycles(50));
}

void a_clock_that_does_not_run_is_refused_in_the_start_up(void**) {
  std::mt19937_64 random(7);
  const auto refused = [](auto tamper, const char* words) {
    MasterBench& bench = fresh_bench();
    bench.ethercat.state_ms = 500;
    ASSERT_OK(bench.load());
    bench.hal.tamper = tamper;
    ASSERT_STATUS(bench.hal.connect(CommandMode::kEffort), Status::kRefusedByRobot);
    const Message said = bench.hal.trouble();
    if (std::strstr(said.c_str(), words) == nullptr) print_error("%s\n", said.c_str());
    assert_non_null(std::strstr(said.c_str(), words));
  };
  refused(clock_of([](std::int64_t) { return std::int64_t{0}; }),
          "the clock of slave 1 (0910h) stands still, its last good time is 0 ns");
  refused(clock_of([&](std::int64_t) { return static_cast<std::int64_t>(random()); }),
          "the clock of slave 1 (0910h) jumps");
  refused(clock_of([](std::int64_t time) { return time; }, 0),
          "slave 1 does not show its clock (0910h)");
}

/// The message of the fault comes before its code is in the inputs, here for good.
void an_emergency_is_told_with_its_own_code(void**) {
  MasterBench& bench = following();
  bench.hal.tamper = Replay({true, false, false});
  bench.add(FaultKind::kEmergency, 4, 0x4310);
  Status status = Status::kOk;
  for (int i = 0; i < 40 && status == Status::kOk; ++i) status = bench.cycle();
  ASSERT_STATUS(status, Status::kDriveFault);
  assert_string_equal(bench.hal.trouble().c_str(),
                      "joint 4: excess temperature of the drive (error code 4310h)");
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_time_must_go_on_and_by_no_more_than_has_passed),
      cmocka_unit_test(a_stall_of_the_computer_is_no_jump),
      cmocka_unit_test(a_clock_of_32_bits_goes_on_where_it_wraps),
      cmocka_unit_test(frozen_feedback_is_not_followed),
      cmocka_unit_test(a_time_that_goes_back_or_far_ahead_is_no_feedback),
      cmocka_unit_test(a_clock_that_is_not_read_is_a_wrong_working_counter),
      cmocka_unit_test(a_few_old_frames_are_bridged),
      cmocka_unit_test(a_clock_that_does_not_run_is_refused_in_the_start_up),
      cmocka_unit_test(an_emergency_is_told_with_its_own_code),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
