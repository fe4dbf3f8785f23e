// A scan of a bus on which nodes answer out of lists.
#include "tests/hal/can/scan_bench.hpp"

namespace tactus::can {
namespace {

// Proves CAN-16.
void every_node_is_asked_once_a_millisecond(void**) {
  Bus& bus = fresh();
  bus.run();
  assert_int_equal(bus.sent.size(), 127);
  for (std::size_t i = 0; i < bus.sent.size(); ++i) {
    assert_int_equal(bus.sent[i].id, 0x601 + i);
    assert_int_equal(bus.sent_ns[i], static_cast<std::int64_t>(i) * kMs_ns);
  }
  assert_int_equal(bus.scan.count(), 0);
  assert_true(bus.now_ns >= 1000 * kMs_ns && bus.now_ns <= 1002 * kMs_ns);
}

void a_drive_is_reported_with_what_it_has(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(5)};
  bus.heartbeats = {heartbeat(5, 0x05)};
  bus.run();
  assert_int_equal(bus.scan.count(), 1);
  const NodeReport& report = bus.scan.report(5);
  assert_true(report.answers && report.heard);
  assert_int_equal(static_cast<int>(report.nmt), 0x05);
  assert_int_equal(report.get(Item::kType), 0x00020192);
  assert_int_equal(report.get(Item::kVendor), 0xAABB);
  assert_int_equal(report.get(Item::kSerial), 77);
  assert_false(report.has(Item::kProduct));
  assert_int_equal(report.get(Item::kStatusword), 0x0637);
  assert_int_equal(report.get(Item::kIncrements), 16777216);
  assert_false(report.has(Item::kRevolutions));
  assert_string_equal(report.label(Label::kName).c_str(), "Servo drive");
  assert_string_equal(report.label(Label::kFirmware).c_str(), "v1");
  assert_true(report.label(Label::kHardware).empty());
  assert_int_equal(report.history_count, 2);
  assert_int_equal(report.history[1], 0x12348130);
  assert_true(report.trouble.empty());
}

void pdos_are_reported_as_they_are_set_up(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(5)};
  bus.run();
  const NodeReport& report = bus.scan.report(5);
  assert_true(report.rpdos[0].valid());
  assert_int_equal(report.rpdos[0].id, 0x201);
  assert_int_equal(report.rpdos[0].type, 1);
  assert_int_equal(report.rpdos[0].count, 2);
  assert_int_equal(report.rpdos[0].entries[1], 0x60710010);
  assert_true(report.rpdos[1].known);
  assert_false(report.rpdos[1].valid());
  assert_false(report.rpdos[2].known);
  assert_false(report.tpdos[0].known);
  assert_true(report.tpdos[1].valid());
  assert_int_equal(report.tpdos[1].entries[0], 0x60640020);
  assert_int_equal(bus.requests(5, 0x1601), 0);
}

void a_scan_only_reads(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(5), drive(6)};
  bus.nodes[1].answers_left = 7;
  bus.run();
  for (const CanFrame& frame : bus.sent) {
    const int specifier = frame.data[0] & 0xE0;  // upload, its segments, abort
    assert_true(frame.id > 0x600 && frame.id < 0x680);
    assert_true(specifier == 0x40 || specifier == 0x60 || specifier == 0x80);
  }
}

void a_device_that_is_no_drive_is_not_asked_for_a_drives_objects(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(9)};
  bus.nodes[0].objects[0].value = 0x00030191;
  bus.run();
  assert_true(bus.scan.report(9).has(Item::kRegister));
  for (const CanFrame& frame : bus.sent)
    if (frame.data[0] == 0x40) assert_true(frame.data[2] < 0x60);
}

void a_node_that_falls_silent_does_not_hide_the_next(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(1), drive(2)};
  bus.nodes[0].answers_left = 4;
  bus.run();
  assert_string_equal(bus.scan.report(1).trouble.c_str(),
                      "node 1: object 1018h:3: no answer within 100 ms (05040000h)");
  assert_true(bus.scan.report(2).trouble.empty());
  assert_true(bus.scan.report(2).tpdos[1].valid());
  assert_int_equal(bus.scan.count(), 2);
}

void a_node_that_boots_while_others_are_asked_is_read_too(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(1)};
  bus.deaf_ns = 50 * kMs_ns;
  bus.heartbeats = {heartbeat(1, 0x00), heartbeat(2, 0x7F)};
  bus.run();
  assert_true(bus.scan.report(1).answers);
  assert_true(bus.scan.report(1).tpdos[1].valid());
  assert_false(bus.scan.report(2).answers);
  assert_string_equal(bus.scan.report(2).trouble.c_str(),
                      "node 2: object 1000h:0: no answer within 100 ms (05040000h)");
}

void the_last_node_has_its_time_to_answer(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(127)};
  bus.delay_ns = 90 * kMs_ns;
  bus.run();
  assert_true(bus.scan.report(127).answers);
  assert_true(bus.scan.report(127).tpdos[1].valid());
}

void a_node_that_sends_pdos_is_known_by_them(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(2), drive(3)};
  CanFrame feedback;
  feedback.id = 0x282;
  bus.heartbeats = {feedback};
  bus.run();
  assert_true(bus.scan.report(2).sends_pdos);
  assert_false(bus.scan.report(3).sends_pdos);
}

void a_stopped_node_is_heard(void**) {
  Bus& bus = fresh();
  bus.heartbeats = {heartbeat(3, 0x04), heartbeat(4, 0x33)};
  bus.run();
  assert_int_equal(bus.scan.count(), 1);
  assert_true(bus.scan.report(3).heard);
  assert_false(bus.scan.report(3).answers);
  assert_int_equal(bus.sent.size(), 127);
}

void lists_longer_than_the_report_are_cut(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(5)};
  for (FakeObject& object : bus.nodes[0].objects)
    if ((object.index == 0x1003 || object.index == 0x1600) && object.sub == 0) object.value = 255;
  for (int sub = 3; sub < 255; ++sub) {
    bus.nodes[0].objects.push_back({0x1003, static_cast<std::uint8_t>(sub), 1});
    bus.nodes[0].objects.push_back({0x1600, static_cast<std::uint8_t>(sub), 1});
  }
  bus.run();
  assert_int_equal(bus.scan.report(5).history_count, 8);
  assert_int_equal(bus.scan.report(5).rpdos[0].count, 255);
  assert_int_equal(bus.requests(5, 0x1600), 17);
  assert_true(bus.scan.report(5).tpdos[1].valid());
}

void a_missing_entry_ends_its_list_and_no_other(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(5)};
  bus.nodes[0].objects[2].value = 5;  // of the error history, two are there
  bus.run();
  assert_int_equal(bus.scan.report(5).history_count, 2);
  assert_int_equal(bus.requests(5, 0x1003), 4);
  assert_true(bus.scan.report(5).rpdos[0].valid());
}

void texts_are_made_fit_for_a_terminal(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(5), drive(6)};
  bus.nodes[0].objects[5].text = "a\033[2Jb";
  bus.nodes[1].objects[5].text = {"c\0d", 3};
  bus.run();
  assert_string_equal(bus.scan.report(5).label(Label::kName).c_str(), "a?[2Jb");
  assert_string_equal(bus.scan.report(6).label(Label::kName).c_str(), "c");
}

void nodes_that_are_slow_do_not_prolong_a_scan_for_ever(void**) {
  Bus& bus = fresh();
  for (int node = 1; node <= 40; ++node) bus.nodes.push_back(drive(node));
  bus.delay_ns = 90 * kMs_ns;
  bus.run();
  assert_true(bus.now_ns <= 60'002 * kMs_ns);
  assert_true(bus.scan.report(1).tpdos[1].valid());
  int cut = 0;
  for (int node = 1; node <= 40; ++node)
    cut += bus.scan.report(node).trouble == std::string_view("the time of the scan is over");
  assert_int_equal(cut, 1);
}

void a_scan_begins_anew(void**) {
  Bus& bus = fresh();
  bus.nodes = {drive(5)};
  bus.run();
  bus.nodes.clear();
  bus.run();
  assert_int_equal(bus.scan.count(), 0);
  assert_false(bus.scan.report(5).has(Item::kType));
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_node_is_asked_once_a_millisecond),
      cmocka_unit_test(a_drive_is_reported_with_what_it_has),
      cmocka_unit_test(pdos_are_reported_as_they_are_set_up),
      cmocka_unit_test(a_scan_only_reads),
      cmocka_unit_test(a_device_that_is_no_drive_is_not_asked_for_a_drives_objects),
      cmocka_unit_test(a_node_that_falls_silent_does_not_hide_the_next),
      cmocka_unit_test(a_node_that_boots_while_others_are_asked_is_read_too),
      cmocka_unit_test(the_last_node_has_its_time_to_answer),
      cmocka_unit_test(a_node_that_sends_pdos_is_known_by_them),
      cmocka_unit_test(a_stopped_node_is_heard),
      cmocka_unit_test(lists_longer_than_the_report_are_cut),
      cmocka_unit_test(a_missing_entry_ends_its_list_and_no_other),
      cmocka_unit_test(texts_are_made_fit_for_a_terminal),
      cmocka_unit_test(nodes_that_are_slow_do_not_prolong_a_scan_for_ever),
      cmocka_unit_test(a_scan_begins_anew),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bus.reset();
  return failed;
}
