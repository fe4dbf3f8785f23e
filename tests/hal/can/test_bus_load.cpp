// The time that frames occupy a bus, against a table computed from ISO 11898-1 by hand.
#include <array>
#include <cmath>

#include "hal/can/bus_load.hpp"
#include "tests/support/testing.hpp"

namespace tactus::can {
namespace {

constexpr BitRates kClassic = {1e6, 0.0}, kFd2 = {1e6, 2e6}, kFd5 = {1e6, 5e6}, kFd8 = {1e6, 8e6};

struct Cell {
  double best, worst;
};
void assert_cell(const WireTime& time, const Cell& cell) {
  ASSERT_NEAR(time.best_us, cell.best, 0.5001);
  ASSERT_NEAR(time.worst_us, cell.worst, 0.5001);
}

// Proves CAN-5.
void single_frames_last_as_long_as_in_the_table(void**) {
  struct Row {
    std::size_t size;
    Cell fd2, fd5, fd8;
  };
  for (const Row& row :
       {Row{0, {46, 51}, {36, 41}, {34, 38}}, Row{4, {62, 71}, {43, 49}, {38, 43}},
        Row{8, {78, 91}, {49, 57}, {42, 48}}, Row{12, {94, 111}, {56, 65}, {46, 53}},
        Row{28, {177, 213}, {89, 106}, {67, 79}}, Row{64, {304, 373}, {140, 170}, {99, 119}}}) {
    assert_cell(wire_time(row.size, true, kFd2), row.fd2);
    assert_cell(wire_time(row.size, true, kFd5), row.fd5);
    assert_cell(wire_time(row.size, true, kFd8), row.fd8);
  }
  assert_cell(wire_time(0, false, kClassic), {47, 55});
  assert_cell(wire_time(4, false, kClassic), {79, 95});
  assert_cell(wire_time(8, false, kClassic), {111, 135});
}

/// The command PDOs of a cycle, and the TPDOs of each joint.
struct Pdos {
  std::size_t size;
  int count;
};
struct Scheme {
  BitRates rates;
  int joints;
  std::array<Pdos, 2> commands, feedback;
  Cell cell;
};
BusLoad load_of(const Scheme& scheme) {
  BusLoad load(scheme.rates);
  load.add(0);
  for (const Pdos& pdo : scheme.commands) load.add(pdo.size, pdo.count);
  for (const Pdos& pdo : scheme.feedback) load.add(pdo.size, pdo.count * scheme.joints);
  return load;
}

constexpr Pdos kNone = {0, 0};
constexpr Scheme kSchemes[] = {
    // A PDO with controlword and torque for each joint, and one back.
    {kClassic, 7, {{{4, 7}, kNone}}, {{{8, 1}, kNone}}, {1377, 1665}},
    {kClassic, 4, {{{4, 4}, kNone}}, {{{8, 1}, kNone}}, {807, 975}},
    {kClassic, 3, {{{4, 3}, kNone}}, {{{8, 1}, kNone}}, {617, 745}},
    {kClassic, 2, {{{4, 2}, kNone}}, {{{8, 1}, kNone}}, {427, 515}},
    // And a second one back, with the velocity.
    {kClassic, 3, {{{4, 3}, kNone}}, {{{8, 1}, {4, 1}}}, {854, 1030}},
    // Torques of four joints in a PDO.
    {kClassic, 7, {{{8, 1}, {6, 1}}}, {{{8, 1}, kNone}}, {1030, 1250}},
    {kClassic, 4, {{{8, 1}, kNone}}, {{{8, 1}, kNone}}, {602, 730}},
    {kClassic, 3, {{{6, 1}, kNone}}, {{{8, 1}, kNone}}, {475, 575}},
    // CAN FD, with the velocity.
    {kFd5, 7, {{{4, 7}, kNone}}, {{{12, 1}, kNone}}, {725, 833}},
    {kFd5, 4, {{{4, 4}, kNone}}, {{{12, 1}, kNone}}, {430, 493}},
    {kFd5, 7, {{{28, 1}, kNone}}, {{{12, 1}, kNone}}, {514, 598}},
    {kFd8, 7, {{{28, 1}, kNone}}, {{{12, 1}, kNone}}, {423, 489}},
    {kFd2, 7, {{{4, 7}, kNone}}, {{{12, 1}, kNone}}, {1138, 1318}},
    {kFd2, 7, {{{28, 1}, kNone}}, {{{12, 1}, kNone}}, {880, 1037}},
};

void whole_cycles_last_as_long_as_in_the_table(void**) {
  for (const Scheme& scheme : kSchemes) {
    const BusLoad load = load_of(scheme);
    assert_cell({load.best_us(), load.worst_us()}, scheme.cell);
  }
}

void a_heartbeat_counts_by_its_share(void**) {
  BusLoad load(kClassic);
  for (int node = 0; node < 7; ++node) load.add(1, 0.1);
  ASSERT_NEAR(load.best_us(), 7 * 5.5, 1e-9);
}

/// The table computes with CAN FD frames only; a node of CiA 301 sends SYNC and heartbeats as
/// classic frames, and those last longer.
void classic_frames_on_a_can_fd_bus_last_as_long_as_on_a_classic_one(void**) {
  BusLoad load(kFd5);
  load.add(0, 1.0, false);
  ASSERT_NEAR(load.best_us(), 47.0, 1e-9);
  ASSERT_NEAR(load.worst_us(), 55.0, 1e-9);
}

void assert_judged(const BusLoad& load, int joints, double period_us, double most,
                   const char* expected, bool packs = true) {
  static Message why;
  why = Message();
  const Status status = load.judge("can0", joints, period_us, most, packs, why);
  ASSERT_STATUS(status, expected[0] == '\0' ? Status::kOk : Status::kOverBudget);
  assert_string_equal(why.c_str(), expected);
}

void a_cycle_that_does_not_fit_is_refused_with_what_helps(void**) {
  assert_judged(load_of(kSchemes[0]), 7, 1000.0, 0.8,
                "bus can0: 1665 us of frames in a cycle of 1000 us, at most 800 us (7 joints, "
                "classic 1000 kbit/s); use more buses, packed commands or CAN FD");
  assert_judged(load_of(kSchemes[8]), 7, 1000.0, 0.8,
                "bus can0: 833 us of frames in a cycle of 1000 us, at most 800 us (7 joints, "
                "CAN FD 1000/5000 kbit/s); use more buses, packed commands or a higher data bit "
                "rate");
  assert_judged(load_of(kSchemes[8]), 7, 1000.0, 0.85, "");
  assert_judged(load_of(kSchemes[0]), 7, 1000.0, 0.8,
                "bus can0: 1665 us of frames in a cycle of 1000 us, at most 800 us (7 joints, "
                "classic 1000 kbit/s); use more buses or CAN FD",
                false);
  assert_judged(load_of(kSchemes[2]), 3, 1000.0, 0.8, "");
}

void the_limit_itself_fits_and_nan_does_not(void**) {
  BusLoad load(kClassic);
  load.add(0);  // 55 us
  assert_judged(load, 1, 110.0, 0.5, "");
  assert_judged(load, 1, 109.9, 0.5,
                "bus can0: 55 us of frames in a cycle of 110 us, at most 55 us (1 joint, classic "
                "1000 kbit/s); use more buses, packed commands or CAN FD");
  static Message why;
  ASSERT_STATUS(load.judge("can0", 1, std::nan(""), 0.8, true, why), Status::kOverBudget);
  load.add(0, std::nan(""));
  ASSERT_STATUS(load.judge("can0", 1, 1000.0, 0.8, true, why), Status::kOverBudget);
}

/// A queue that is known to hold nothing is none.
void a_queue_shorter_than_a_cycle_is_refused(void**) {
  static Message why;
  ASSERT_OK(judge_queue("can0", 10, 10, why));
  ASSERT_OK(judge_queue("can0", -1, 10, why));
  for (const int queue : {0, 1, 9}) {
    ASSERT_STATUS(judge_queue("can0", queue, 10, why), Status::kTooLarge);
    static Message expected;
    expected = Message("bus can0: its queue holds ");
    expected << queue << " frames, a cycle sends up to 10; ip link set can0 txqueuelen 64";
    assert_string_equal(why.c_str(), expected.c_str());
  }
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(single_frames_last_as_long_as_in_the_table),
      cmocka_unit_test(whole_cycles_last_as_long_as_in_the_table),
      cmocka_unit_test(a_heartbeat_counts_by_its_share),
      cmocka_unit_test(classic_frames_on_a_can_fd_bus_last_as_long_as_on_a_classic_one),
      cmocka_unit_test(a_cycle_that_does_not_fit_is_refused_with_what_helps),
      cmocka_unit_test(the_limit_itself_fits_and_nan_does_not),
      cmocka_unit_test(a_queue_shorter_than_a_cycle_is_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
