// A segment with drives that cannot read and write in one datagram (0008h bit 9): LRD and LWR in
// the frame of the cycle instead of LRW, for all drives.
#include <cstring>
#include <string>

#include "tests/hal/cia402/equality.hpp"
#include "tests/hal/ethercat/master_bench.hpp"
#include "tests/hal/ethercat/segment_bench.hpp"

namespace tactus::ethercat {
namespace {

/// The commands of a frame by their numbers (IEC 61158-4-12): 10 is LRD, 11 LWR, 12 LRW, 14 FRMW,
/// 4 FPRD.
std::string commands_of(Frame& frame) {
  FrameReader reader(frame);
  Datagram datagram;
  std::string commands;
  while (reader.next(datagram))
    commands += std::to_string(static_cast<int>(datagram.command)) + " ";
  return commands;
}

// Proves ECAT-18.
void one_drive_without_lrw_has_all_read_and_written_apart_in_one_frame(void**) {
  for (int slave = -1; slave < kDof; ++slave) {
    MasterBench& bench = fresh_bench();
    if (slave >= 0) bench.plant.no_lrw[static_cast<std::size_t>(slave)] = true;
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.start());
    const int exchanges = bench.hal.exchanges;
    bool right = true;
    bench.hal.tamper = [&right, slave](Frame& frame) {
      right = right && commands_of(frame) == (slave < 0 ? "12 14 4 4 " : "10 11 14 4 4 ");
    };
    ASSERT_OK(bench.cycles(50));
    assert_true(right);
    assert_int_equal(bench.hal.exchanges - exchanges, 50);
    const LineCounts& counts = bench.hal.master.counts();
    assert_int_equal(counts.lost + counts.late + counts.counter + counts.strange, 0);
  }
}

/// A command acts as long after the sample that it answers as with LRW.
void a_motion_without_lrw_is_the_same(void**) {
  static MasterBench bench;
  bench.plant.no_lrw.fill(true);
  ASSERT_OK(bench.load());
  cia402::compare_with_the_linked_in_robot(bench);
}

/// What a drive that is missing would have read is what was sent, whichever of the two it missed.
void a_wrong_counter_of_either_leaves_the_inputs_as_they_are(void**) {
  for (const Command wrong : {Command::kLrd, Command::kLwr}) {
    MasterBench& bench = fresh_bench();
    bench.plant.no_lrw[3] = true;
    ASSERT_OK(bench.load());
    ASSERT_OK(bench.start());
    ASSERT_OK(bench.cycles(20));
    const JointVector before = bench.pipeline.robot.q.value;
    int frames = 3;
    bench.hal.tamper = [&frames, wrong](Frame& frame) {
      if (frames-- <= 0) return;
      FrameReader reader(frame);
      Datagram datagram;
      while (reader.next(datagram)) {
        if (datagram.command == Command::kLrd) std::memset(datagram.data, 0, datagram.size);
        if (datagram.command == wrong) datagram.set_counter(kDof - 1);
      }
    };
    for (int i = 0; i < 3; ++i) {
      ASSERT_OK(bench.cycle());
      assert_true((bench.pipeline.robot.q.value - before).cwiseAbs().maxCoeff() < 1e-3);
    }
    ASSERT_OK(bench.cycles(20));
    assert_int_equal(bench.hal.master.counts().counter, 3);
  }
}

void a_counter_that_stays_wrong_is_named(void**) {
  for (const bool lrw : {true, false}) {
    MasterBench& bench = fresh_bench();
    bench.plant.no_lrw[6] = !lrw;
    ASSERT_OK(bench.load());
    bench.add(segment::LineFaultKind::kCounter, 0, 0, 1 << 30, 0xFFFF);
    ASSERT_STATUS(bench.hal.connect(CommandMode::kEffort), Status::kBusTimeout);
    assert_string_equal(
        bench.hal.trouble().c_str(),
        lrw ? "the working counter of LRW is 20, expected 21: a drive does not read "
              "or write its process data"
            : "the working counter of LRD is 6, expected 7, that of LWR is 6, "
              "expected 7: a drive does not read or write its process data");
  }
}

/// The emulated controller lets LRW pass, as one that does not have it.
void the_emulated_controller_does_not_count_in_lrw(void**) {
  static segment::SegmentBench bench;
  bench.settings.slaves = 1;
  bench.settings.no_lrw[0] = true;
  bench.load();
  bench.give_stations();
  bench.write_fmmu(0, 0, 0x10000, 2, 0x1800, kFmmuWrite);
  bench.write_fmmu(0, 1, 0x10002, 2, 0x1900, kFmmuRead);
  const std::uint32_t sent = 0x55AA1234;
  assert_int_equal(bench.send(Command::kLrw, 0x10000, &sent, 4), 0);
  assert_int_equal(bench.dword(), sent);
  assert_int_equal(bench.send(Command::kLwr, 0x10000, &sent, 4), 1);
  assert_int_equal(bench.send(Command::kLrd, 0x10000, &sent, 4), 1);
  assert_int_equal(bench.dword(), 0x00001234);
  assert_int_equal(bench.read(0, 0x0008, 2), 1);
  assert_int_equal(bench.word() & 0x0200, 0x0200);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(one_drive_without_lrw_has_all_read_and_written_apart_in_one_frame),
      cmocka_unit_test(a_motion_without_lrw_is_the_same),
      cmocka_unit_test(a_wrong_counter_of_either_leaves_the_inputs_as_they_are),
      cmocka_unit_test(a_counter_that_stays_wrong_is_named),
      cmocka_unit_test(the_emulated_controller_does_not_count_in_lrw),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
