// SYNC0 of the slaves: from the start-up of drives that demand it to the frames of the cycles.
#include <algorithm>
#include <cinttypes>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "tests/hal/ethercat/master_bench.hpp"
#include "tests/support/random.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::int64_t kUs_ns = 1000;

std::int64_t minus(std::int64_t a, std::int64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) - static_cast<std::uint64_t>(b));
}
std::int64_t reg64(const segment::Esc& esc, std::uint16_t reg) {
  const std::uint64_t high = esc.reg32(static_cast<std::uint16_t>(reg + 4));
  return static_cast<std::int64_t>(high << 32 | esc.reg32(reg));
}

/// SYNC0 as the registers of a slave have it and its own clock shows it.
struct Pulses {
  segment::Esc& esc;
  std::int64_t hop_ns;  // from the first slave

  std::int64_t cycle_ns() const { return esc.reg32(kSyncCycleReg); }
  /// Number of the last pulse before a frame that passes the first slave at `time_ns`.
  std::int64_t before(std::int64_t time_ns) const {
    const std::int64_t since = since_start(time_ns);
    return since / cycle_ns() - (since % cycle_ns() < 0);
  }
  std::int64_t until_next(std::int64_t time_ns) const {
    return (before(time_ns) + 1) * cycle_ns() - since_start(time_ns);
  }

 private:
  std::int64_t since_start(std::int64_t time_ns) const {
    return minus(esc.clock().system(time_ns + hop_ns), reg64(esc, kSyncStartReg));
  }
};
Pulses pulses_of(MasterBench& bench, int slave) {
  return {bench.hal.line.slave(slave).esc(), slave * segment::Segment::kHop_ns};
}

/// Cycles in step with the reference clock, before the drives are armed; each is late by what
/// `late_ns` says. Returns when their frames passed the first slave.
std::vector<std::int64_t> steered(MasterBench& bench, int cycles,
                                  const std::function<std::int64_t(int)>& late_ns) {
  std::vector<std::int64_t> times;
  for (int k = 0; k < cycles; ++k) {
    bench.now_ns += bench.period_ns() + bench.hal.master.steer().correction();
    ASSERT_STATUS(bench.executive.cycle({bench.now_ns + late_ns(k)}), Status::kNotStarted);
    times.push_back(bench.hal.time_ns());
  }
  return times;
}
std::int64_t punctual(int) {
  return 0;
}

void assert_refused(MasterBench& bench, Status status, const char* words) {
  ASSERT_STATUS(bench.hal.connect(CommandMode::kEffort), status);
  const Message said = bench.hal.trouble();
  if (std::strstr(said.c_str(), words) == nullptr) print_error("%s\n", said.c_str());
  assert_non_null(std::strstr(said.c_str(), words));
}

// Proves ECAT-23.
void drives_that_demand_sync0_need_the_setting_that_their_refusal_names(void**) {
  for (int slave = 0; slave < kDof; ++slave) {
    MasterBench& bench = fresh_bench();
    bench.plant.sync0[static_cast<std::size_t>(slave)] = true;
    ASSERT_OK(bench.load());
    const std::string expected =
        "joint " + std::to_string(slave + 1) + " (slave " + std::to_string(slave + 1) +
        "): refuses SAFEOP: invalid clock synchronization configuration (0030h); add [ethercat] "
        "sync0_us, for example 500, half of the period";
    assert_refused(bench, Status::kRefusedByRobot, expected.c_str());
    bench.ethercat.sync0_us = 500;
    ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
    ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
    for (int i = 0; i < kDof; ++i) assert_int_equal(bench.hal.line.slave(i).state(), AlState::kOp);
  }
}

/// Drives that miss it only on the way to OP, with whichever code.
void a_drive_that_stays_in_safeop_without_sync0_is_told_of_the_setting(void**) {
  for (const int code : {0x002D, 0x0030, 0x0035, 0x0036, 0x001B}) {
    MasterBench& bench = fresh_bench();
    bench.ethercat.state_ms = 50;
    ASSERT_OK(bench.load());
    bench.hal.tamper = [code](Frame& frame) {
      FrameReader reader(frame);
      Datagram datagram;
      if (!reader.next(datagram) || datagram.command != Command::kLrw) return;
      while (reader.next(datagram)) {
        if (datagram.reg() != 0x0130 || datagram.position() != 0x1003) continue;
        put<std::uint16_t>(datagram.data, 0x0014);
        put(datagram.data + 4, static_cast<std::uint16_t>(code));
      }
    };
    assert_refused(bench, Status::kRefusedByRobot, "joint 3 (slave 3): is in SAFEOP, not in OP");
    const bool told = std::strstr(bench.hal.trouble().c_str(), "h); add [ethercat] sync0_us, ");
    assert_int_equal(told, code != 0x001B);
  }
}

/// Whatever the clocks show, and however they differ when power comes on.
void sync0_of_all_slaves_comes_at_its_time_after_the_steered_frames(void**) {
  constexpr int kPeriods_us[] = {500, 1000, 2000, 4000};
  Random random{11};
  for (int trial = 0; trial < 24; ++trial) {
    MasterBench& bench = fresh_bench();
    const int period_us = kPeriods_us[random.below(4)];
    bench.ethercat.sync0_us = random.below(period_us);
    bench.plant.sync0.fill(true);
    std::string text = cia402::kHoldingPipeline;
    text.replace(text.find("1000"), 4, std::to_string(period_us));
    ASSERT_OK(bench.load(text.c_str()));
    for (int i = 0; i < kDof; ++i) {
      const std::uint64_t high = static_cast<std::uint32_t>(random.below(1 << 30)) * 4ULL;
      const auto start_ns = static_cast<std::int64_t>(high << 32 | 0x12345678U);
      bench.hal.line.slave(i).esc().clock() = {start_ns, random.below(100'000) - 50'000};
    }
    int activated = 0;
    bench.hal.tamper = [&](Frame& frame) {
      FrameReader reader(frame);
      Datagram datagram;
      const bool on = reader.next(datagram) && datagram.command == Command::kFpwr &&
                      datagram.reg() == 0x0980 && get<std::uint16_t>(datagram.data) == 0x0300;
      if (!on) return;
      segment::Esc& esc = bench.hal.line.slave(activated++).esc();
      const std::int64_t left_ns =
          minus(reg64(esc, 0x0990), esc.clock().system(bench.hal.time_ns()));
      assert_in_range(left_ns, 90'000'000, 110'000'000);
    };
    ASSERT_OK(bench.connect());
    assert_int_equal(activated, kDof);
    bench.hal.tamper = nullptr;
    const std::int64_t last = steered(bench, 300, punctual).back();
    for (int i = 0; i < kDof; ++i) {
      const Pulses pulses = pulses_of(bench, i);
      assert_int_equal(pulses.cycle_ns(), period_us * kUs_ns);
      std::int64_t off_ns = pulses.until_next(last) - bench.ethercat.sync0_us * kUs_ns;
      if (off_ns > pulses.cycle_ns() / 2) off_ns -= pulses.cycle_ns();
      if (std::abs(off_ns) >= 10'000)
        print_error("slave %d, period %d us, shift %d us: off by %" PRId64 " ns\n", i + 1,
                    period_us, bench.ethercat.sync0_us, off_ns);
      assert_true(std::abs(off_ns) < 10'000);
    }
  }
}

/// By the emulated clocks and registers.
void the_summary_has_the_times_before_sync0_that_the_frames_had(void**) {
  Random random{5};
  for (const int shift_us : {0, 300, 500, 900}) {
    MasterBench& bench = fresh_bench();
    bench.ethercat.sync0_us = shift_us;
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.connect());
    const auto times = steered(bench, 500, [&](int) { return random.below(80'000); });
    const Pulses pulses = pulses_of(bench, 0), last = pulses_of(bench, kDof - 1);
    std::int64_t least = INT64_MAX, most = 0, skipped = 0;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {  // the last frame has not been read
      if (last.before(times[k]) < 0) continue;            // nor has SYNC0 begun
      least = std::min(least, pulses.until_next(times[k]));
      most = std::max(most, pulses.until_next(times[k]));
      if (last.before(times[k - 1]) >= 0)
        skipped +=
            std::max(pulses.before(times[k]) - pulses.before(times[k - 1]) - 1, std::int64_t{0});
    }
    const Sync0Watch& seen = bench.hal.master.sync0();
    print_message("shift %d us: %" PRId64 " to %" PRId64 " ns, %" PRId64 " after it\n", shift_us,
                  seen.least_ns(), seen.most_ns(), seen.without_frame());
    assert_true(seen.known());
    assert_true(std::abs(seen.least_ns() - least) < 100);
    assert_true(std::abs(seen.most_ns() - most) < 100);
    assert_int_equal(seen.without_frame(), skipped);
    assert_int_equal(skipped > 0, shift_us == 0);
  }
}

void a_frame_counts_that_is_later_than_its_room(void**) {
  MasterBench& bench = fresh_bench();
  bench.ethercat.sync0_us = 300;
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.connect());
  const Sync0Watch& seen = bench.hal.master.sync0();
  static_cast<void>(steered(bench, 150, punctual));
  assert_true(seen.known());
  static_cast<void>(steered(bench, 50, [](int k) { return k % 10 == 5 ? 250 * kUs_ns : 0; }));
  assert_int_equal(seen.without_frame(), 0);
  bench.add(segment::LineFaultKind::kLose, 0, 5, 2);
  static_cast<void>(steered(bench, 50, punctual));
  assert_int_equal(bench.hal.master.counts().lost, 2);
  assert_int_equal(seen.without_frame(), 0);
  static_cast<void>(steered(bench, 50, [](int k) { return k % 20 == 5 ? 400 * kUs_ns : 0; }));
  assert_int_equal(seen.without_frame(), 3);
  bench.now_ns += 2 * bench.period_ns();  // cycles that were missed
  static_cast<void>(steered(bench, 50, punctual));
  assert_int_equal(seen.without_frame(), 5);
}

/// Periods that 60C2h cannot say are refused; of the others a drive compares SYNC0 with 60C2h.
void the_drives_have_the_period_or_it_is_refused(void**) {
  for (const int period_us : {500, 555, 750, 999, 1250, 2550, 2560, 3001, 8000, 19'999}) {
    MasterBench& bench = fresh_bench();
    bench.plant.sync0.fill(true);
    bench.ethercat.sync0_us = period_us / 2;
    std::string text = cia402::kHoldingPipeline;
    text.replace(text.find("1000"), 4, std::to_string(period_us));
    const Status status = bench.load(text.c_str());
    const bool can = period_us % 1000 == 0 || (period_us % 10 == 0 && period_us <= 2550);
    ASSERT_STATUS(status, can ? Status::kOk : Status::kBadValue);
    if (can) ASSERT_OK(bench.connect());
  }
}

/// Its pulses would begin when the clock has wrapped.
void a_start_time_that_has_passed_is_written_again(void**) {
  for (const int passed : {1, 4, 5}) {
    MasterBench& bench = fresh_bench();
    bench.ethercat.sync0_us = 500;
    ASSERT_OK(bench.load());
    int activated = 0, left = passed;
    bool on = false;
    bench.hal.tamper = [&](Frame& frame) {
      FrameReader reader(frame);
      Datagram datagram;
      if (!reader.next(datagram)) return;
      if (on && left-- > 0)
        put(datagram.data, get<std::int64_t>(datagram.data) + std::int64_t{200'000'000});
      on = datagram.command == Command::kFpwr && datagram.reg() == 0x0980 && datagram.data[1] == 3;
      activated += on;
    };
    if (passed < 5) {
      ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
      assert_int_equal(activated, kDof + passed);
    } else {
      assert_refused(bench, Status::kBusTimeout, "joint 1 (slave 1): SYNC0 cannot be started");
    }
  }
}

void clocks_are_waited_for_and_one_that_does_not_follow_is_refused(void**) {
  MasterBench& slow = fresh_bench();
  slow.ethercat.sync0_us = 500;
  slow.ethercat.clock_frames = 0;
  slow.plant.drift_ppb = 200'000;
  ASSERT_OK(slow.load());
  ASSERT_OK(slow.hal.connect(CommandMode::kEffort));
  print_message("%" PRId64 " ns apart\n", slow.hal.master.apart_ns());
  assert_true(slow.hal.master.apart_ns() <= 10'000);

  MasterBench& bench = fresh_bench();
  bench.ethercat.sync0_us = 500;
  bench.ethercat.state_ms = 50;
  ASSERT_OK(bench.load());
  int asked = 0;
  bench.hal.tamper = [&asked](Frame& frame) {
    FrameReader reader(frame);
    Datagram datagram;
    if (!reader.next(datagram) || datagram.reg() != 0x092C || datagram.position() != 0x1004) return;
    put<std::uint32_t>(datagram.data, 0x80000000U | 12'000U);
    ++asked;
  };
  assert_refused(bench, Status::kRefusedByRobot,
                 "joint 4 (slave 4): its clock does not follow that of slave 1: they are 12000 ns "
                 "apart (092Ch) after [ethercat] state_ms, 50 ms, at most 10000");
  assert_true(asked > 100);
}

/// 0008h: bit 2, clocks; bit 3, of 64 bits.
void a_slave_without_the_clock_that_is_needed_is_refused(void**) {
  struct Row {
    int slave;
    unsigned missing;
    const char* words;
  };
  for (const Row& row :
       {Row{4, 0x0C,
            "joint 4 (slave 4): has no clock (0008h is 0000h), but [ethercat] sync0_us is "
            "0: SYNC0 needs one in every slave; leave sync0_us out"},
        Row{1, 0x08,
            "joint 1 (slave 1): its clock has 32 bits (0008h is 0004h), but [ethercat] "
            "sync0_us is 0: SYNC0 needs 64 bits in slave 1; leave sync0_us out"},
        Row{5, 0x08, nullptr}}) {
    MasterBench& bench = fresh_bench();
    bench.ethercat.sync0_us = 0;
    ASSERT_OK(bench.load());
    bench.hal.tamper = [&row](Frame& frame) {
      FrameReader reader(frame);
      Datagram datagram;
      if (reader.next(datagram) && datagram.reg() == 0 && datagram.size == 16 &&
          datagram.position() == 0x1000 + row.slave)
        datagram.data[8] = static_cast<std::uint8_t>(datagram.data[8] & ~row.missing);
    };
    if (row.words != nullptr) assert_refused(bench, Status::kRefusedByRobot, row.words);
    bench.ethercat.sync0_us = row.words != nullptr ? -1 : 0;  // the remedy
    ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
  }
}

void a_time_beyond_the_period_is_refused_by_name(void**) {
  MasterBench& bench = fresh_bench();
  bench.ethercat.sync0_us = 1000;
  ASSERT_STATUS(bench.load(), Status::kBadValue);
  assert_string_equal(bench.hal.trouble().c_str(),
                      "[ethercat] sync0_us is 1000, which must be less than the period of 1000 us");
  MasterBench& other = fresh_bench();
  other.ethercat.sync0_us = 999;
  ASSERT_OK(other.load());
}

/// ETG.1020: 1C32h:1 and 1C33h:1 are 2 for SYNC0. Drives may refuse both, as the emulated ones do.
void the_type_of_synchronization_is_written_with_sync0_only(void**) {
  for (const bool given : {false, true}) {
    MasterBench& bench = fresh_bench();
    bench.ethercat.sync0_us = given ? 500 : -1;
    ASSERT_OK(bench.load());
    int written = 0, pulses = 0;
    bench.hal.tamper = [&](Frame& frame) {
      FrameReader reader(frame);
      Datagram datagram;
      if (!reader.next(datagram) || datagram.command != Command::kFpwr) return;
      pulses += datagram.reg() >= 0x0980 && datagram.reg() < 0x09A4;
      const std::uint8_t* const sdo = datagram.data + 8;
      const unsigned index = datagram.size > 16 ? get<std::uint16_t>(sdo + 1) : 0;
      if (index != 0x1C32 && index != 0x1C33) return;
      assert_int_equal(sdo[0], 0x2B);  // download of two bytes
      assert_int_equal(sdo[3], 1);
      assert_int_equal(get<std::uint32_t>(sdo + 4), 2);
      ++written;
    };
    ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
    assert_int_equal(written, given ? 2 * kDof : 0);
    assert_int_equal(pulses > 0, given);
  }
}

/// The codes of an emulated drive, by the registers (ETG.1000.6).
void an_emulated_drive_judges_sync0(void**) {
  struct Row {
    std::uint16_t reg;
    std::uint64_t value;
    const char* words;
  };
  for (const Row& row : {Row{kSyncCycleReg, 999'999, "(0036h)"}, Row{kSyncStartReg, 1, "(0030h)"},
                         Row{kDcControlReg, 0x0100, "(0030h)"}}) {
    MasterBench& bench = fresh_bench();
    bench.plant.sync0[2] = true;
    bench.ethercat.sync0_us = 500;
    ASSERT_OK(bench.load());
    bench.hal.change = [&row](Frame& frame) {
      FrameReader reader(frame);
      Datagram datagram;
      if (reader.next(datagram) && datagram.reg() == row.reg && datagram.command == Command::kFpwr)
        std::memcpy(datagram.data, &row.value, datagram.size);
    };
    assert_refused(bench, Status::kRefusedByRobot, row.words);
    assert_null(std::strstr(bench.hal.trouble().c_str(), "add [ethercat]"));
  }
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(drives_that_demand_sync0_need_the_setting_that_their_refusal_names),
      cmocka_unit_test(a_drive_that_stays_in_safeop_without_sync0_is_told_of_the_setting),
      cmocka_unit_test(sync0_of_all_slaves_comes_at_its_time_after_the_steered_frames),
      cmocka_unit_test(the_summary_has_the_times_before_sync0_that_the_frames_had),
      cmocka_unit_test(a_frame_counts_that_is_later_than_its_room),
      cmocka_unit_test(the_drives_have_the_period_or_it_is_refused),
      cmocka_unit_test(a_start_time_that_has_passed_is_written_again),
      cmocka_unit_test(clocks_are_waited_for_and_one_that_does_not_follow_is_refused),
      cmocka_unit_test(a_slave_without_the_clock_that_is_needed_is_refused),
      cmocka_unit_test(a_time_beyond_the_period_is_refused_by_name),
      cmocka_unit_test(the_type_of_synchronization_is_written_with_sync0_only),
      cmocka_unit_test(an_emulated_drive_judges_sync0),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
