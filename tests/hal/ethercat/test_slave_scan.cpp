// The scan of a segment: what it reports, and that it changes nothing.
#include "hal/ethercat/slave_scan.hpp"
#include "tests/hal/ethercat/segment_bench.hpp"

namespace tactus::segment {
namespace {

SlaveScan::Progress run(SegmentBench& bench, SlaveScan& scan) {
  SlaveScan::Progress progress = SlaveScan::Progress::kBusy;
  for (int i = 0; i < 20000 && progress == SlaveScan::Progress::kBusy; ++i) {
    Frame frame;
    if (scan.exchange().take(frame)) bench.line.receive(frame, bench.now_ns);
    bench.line.advance(bench.now_ns += 100'000);
    while (bench.line.take(frame)) scan.exchange().receive(frame);
    progress = scan.advance(bench.now_ns);
  }
  return progress;
}

// Proves ECAT-9.
void every_slave_is_reported_as_it_is(void**) {
  static SegmentBench bench;
  static SlaveScan scan;
  bench.settings.slaves = 3;
  bench.load();
  bench.to_preop();
  bench.line.slave(2).fall(0x001A);
  scan.begin_count(bench.now_ns);
  assert_true(run(bench, scan) == SlaveScan::Progress::kDone);
  assert_int_equal(scan.count(), 3);
  for (int i = 0; i < 3; ++i) {
    scan.begin(i, bench.now_ns);
    assert_true(run(bench, scan) == SlaveScan::Progress::kDone);
    const SlaveReport& report = scan.report();
    assert_string_equal(report.name.c_str(), "Tactus emulated servo drive");
    assert_int_equal(report.identity.vendor, 0x5443);
    assert_int_equal(report.identity.product, 402);
    assert_int_equal(report.identity.serial, 1001 + i);
    assert_int_equal(report.station, 0x1001 + i);
    assert_int_equal(report.al_status, i == 2 ? 0x12 : 2);
    assert_int_equal(report.al_code, i == 2 ? 0x001A : 0);
    assert_true(report.coe);
    assert_int_equal(report.output_count, 1);
    assert_int_equal(report.outputs[0].index, 0x1600);
    assert_int_equal(report.outputs[0].layout.bytes(), 8);
    assert_int_equal(report.outputs[0].layout.entry(1), 0x60710010);
    assert_int_equal(report.inputs[0].layout.bytes(), 16);
  }
  assert_int_equal(bench.line.slave(0).state(), AlState::kPreop);
}

void a_line_that_does_not_answer_ends_the_scan(void**) {
  static SegmentBench bench;
  static SlaveScan scan;
  bench.load();
  LineFault fault;
  bench.line.add(fault);
  scan.begin_count(bench.now_ns);
  assert_true(run(bench, scan) == SlaveScan::Progress::kLost);
}

}  // namespace
}  // namespace tactus::segment

int main() {
  using namespace tactus::segment;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_slave_is_reported_as_it_is),
      cmocka_unit_test(a_line_that_does_not_answer_ends_the_scan),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
