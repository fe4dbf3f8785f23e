// The start-up of the master with the emulated segment: OP, and refusals that name the slave.
#include <cstdio>
#include <cstring>
#include <string>

#include "tests/hal/ethercat/master_bench.hpp"

namespace tactus::ethercat {
namespace {

// Proves ECAT-5.
void seven_drives_are_brought_to_op_and_none_is_enabled(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  const Status status = bench.executive.start();
  if (status != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
  ASSERT_OK(status);
  for (int i = 0; i < kDof; ++i) {
    assert_int_equal(bench.hal.line.slave(i).state(), AlState::kOp);
    assert_false(bench.hal.line.slave(i).axis().powered());
    assert_int_equal(bench.hal.master.slave(i).identity.serial, 1001 + i);
    assert_int_equal(bench.hal.master.slave(i).data.outputs.bytes(), 4);
    assert_int_equal(bench.hal.master.slave(i).data.inputs.bytes(), 14);
  }
  assert_int_equal(bench.hal.line.malformed(), 0);
}

void every_mode_gets_its_mapping(void**) {
  struct Row {
    CommandMode mode;
    std::size_t outputs;
  };
  for (const Row& row : {Row{CommandMode::kEffort, 4}, Row{CommandMode::kVelocity, 8},
                         Row{CommandMode::kPosition, 12}}) {
    MasterBench& bench = fresh_bench();
    ASSERT_OK(bench.load());
    ASSERT_OK(
        bench.hal.master.configure(bench.ethercat, bench.drive, Tool{}, row.mode, 1000, 10000));
    ASSERT_OK(bench.hal.connect(row.mode));
    assert_int_equal(bench.hal.master.slave(3).data.outputs.bytes(), row.outputs);
    assert_int_equal(bench.hal.line.slave(3).dictionary().get(drives::slot_of(0x6061)),
                     static_cast<int>(cia402::mode_of(row.mode)));
  }
}

/// CoE: no PDO assigned, no entries, entries, their number, the PDO, the number of PDOs. Real
/// drives refuse the mapping of a PDO that is assigned.
void pdos_are_mapped_while_they_are_not_assigned(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  std::string written;
  bench.hal.tamper = [&written](Frame& frame) {
    FrameReader reader(frame);
    Datagram datagram;
    const bool first = reader.next(datagram) && datagram.command == Command::kFpwr &&
                       datagram.position() == 0x1001 && datagram.reg() == 0x1000;
    const std::uint8_t* const sdo = datagram.data + 8;
    if (!first || (sdo[0] & 0xE0) != 0x20) return;
    const unsigned index = get<std::uint16_t>(sdo + 1), value = get<std::uint32_t>(sdo + 4);
    if (index != 0x1C12 && index != 0x1600) return;
    char text[32];
    std::snprintf(text, sizeof text, "%04X:%d=%X ", index, sdo[3], value);
    written += text;
  };
  ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
  assert_string_equal(written.c_str(),
                      "1C12:0=0 1600:0=0 1600:1=60400010 1600:2=60710010 1600:0=2 1C12:1=1600 "
                      "1C12:0=1 ");
}

void slaves_may_be_in_any_order_and_state(void**) {
  MasterBench& bench = fresh_bench();
  bench.ethercat.slave << 4, 3, 2, 1, 7, 6, 5;
  ASSERT_OK(bench.load());
  bench.hal.line.slave(2).fall(0x001B);
  // The joints of the plant are in another order, so that a position may be out of its joint's
  // range.
  const Status status = bench.hal.connect(CommandMode::kEffort);
  assert_true(status == Status::kOk || status == Status::kNotReferenced);
  constexpr int kSerials[] = {1004, 1003, 1002, 1001, 1007, 1006, 1005};
  for (int i = 0; i < kDof; ++i) {
    assert_int_equal(bench.hal.master.slave(i).identity.serial, kSerials[i]);
    assert_int_equal(bench.hal.line.slave(i).state(), AlState::kOp);
  }
}

void a_second_start_up_follows_a_first_one(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
  ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
  bench.hal.line.slave(4).fall(0x001B);
  ASSERT_OK(bench.hal.connect(CommandMode::kEffort));
}

void lost_frames_of_the_start_up_are_sent_again(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  bench.hal.lose_every = 97;
  const Status status = bench.hal.connect(CommandMode::kEffort);
  if (status != Status::kOk) print_error("%s\n", bench.hal.trouble().c_str());
  ASSERT_OK(status);
}

void assert_refused(MasterBench& bench, Status status, const char* words) {
  ASSERT_STATUS(bench.hal.connect(CommandMode::kEffort), status);
  const Message said = bench.hal.trouble();
  if (std::strstr(said.c_str(), words) == nullptr) print_error("%s\n", said.c_str());
  assert_non_null(std::strstr(said.c_str(), words));
}

// Proves ECAT-15.
/// However far it has come: by a signal, or a refusal of the last drive.
void a_start_up_that_is_given_up_leaves_the_slaves_in_init(void**) {
  MasterBench& whole_way = fresh_bench();
  ASSERT_OK(whole_way.load());
  ASSERT_OK(whole_way.hal.connect(CommandMode::kEffort));
  const int all = whole_way.hal.exchanges;
  for (const int frames : {all / 10, all / 3, all - 120, all - 3}) {
    MasterBench& bench = fresh_bench();
    ASSERT_OK(bench.load());
    bench.hal.give_up_after = frames;
    ASSERT_STATUS(bench.hal.connect(CommandMode::kEffort), Status::kArming);
    int beyond = 0;
    for (int i = 0; i < kDof; ++i) beyond += bench.hal.line.slave(i).state() != AlState::kInit;
    print_message("%d of %d frames: %d slaves are beyond INIT\n", frames, all, beyond);
    ASSERT_OK(bench.hal.disconnect());
    for (int i = 0; i < kDof; ++i)
      assert_int_equal(bench.hal.line.slave(i).state(), AlState::kInit);
  }
}

/// A line that is not ours is left as it is.
void slaves_that_are_too_few_are_not_touched(void**) {
  MasterBench& bench = fresh_bench();
  bench.plant.slaves = 6;
  ASSERT_OK(bench.load());
  ASSERT_STATUS(bench.hal.connect(CommandMode::kEffort), Status::kBusTimeout);
  const int exchanges = bench.hal.exchanges;
  ASSERT_OK(bench.hal.disconnect());
  assert_int_equal(bench.hal.exchanges, exchanges);
}

void a_segment_of_another_length_is_refused(void**) {
  MasterBench& bench = fresh_bench();
  bench.plant.slaves = 6;
  ASSERT_OK(bench.load());
  assert_refused(bench, Status::kBusTimeout, "the segment has 6 slaves, expected 7");
  MasterBench& open = fresh_bench();
  ASSERT_OK(open.load());
  open.add(segment::LineFaultKind::kBreak, 0, 0, 1 << 30);
  assert_refused(open, Status::kBusTimeout, "no frame came back");
}

/// Also in the cycles before OP, when the states of the slaves are known.
void a_wire_that_falls_silent_is_named_wherever_the_start_up_is(void**) {
  MasterBench& whole_way = fresh_bench();
  ASSERT_OK(whole_way.load());
  ASSERT_OK(whole_way.hal.connect(CommandMode::kEffort));
  const int all = whole_way.hal.exchanges;
  for (const int frames : {all / 3, all - 100, all - 30, all - 3}) {
    MasterBench& bench = fresh_bench();
    ASSERT_OK(bench.load());
    bench.hal.silent_after = frames;
    assert_refused(bench, Status::kBusTimeout, "no frame came back from the segment; check power");
    assert_true(bench.hal.exchanges < frames + 400);
  }
}

void a_wrong_drive_is_named_with_what_it_says(void**) {
  MasterBench& bench = fresh_bench();
  bench.drive.rated_torque[2] = 4.0;
  ASSERT_OK(bench.load());
  assert_refused(bench, Status::kRefusedByRobot,
                 "joint 3 (slave 3): rated torque in mN m (6076h:0) is 3000, expected 4000");
  MasterBench& weak = fresh_bench();
  weak.plant.torque_share = 0.0;
  ASSERT_OK(weak.load());
  assert_refused(weak, Status::kRefusedByRobot,
                 "joint 1 (slave 1): its own torque limit (6072h:0) is 0 permille");
  MasterBench& other_unit = fresh_bench();
  other_unit.plant.velocity_unit = 0x00B44700;
  other_unit.drive.velocity_units.setConstant(16777216.0);
  ASSERT_OK(other_unit.load());
  assert_refused(
      other_unit, Status::kRefusedByRobot,
      "its velocities have 60 units per motor revolution per second (60A9h is 00B44700h)");
  MasterBench& exchanged = fresh_bench();
  exchanged.drive.serial << 1003, 1002, 1001, 1004, 1005, 1006, 1007;
  ASSERT_OK(exchanged.load());
  assert_refused(exchanged, Status::kRefusedByRobot,
                 "joint 1 (slave 1): its serial number (1018h:4) is 1001, [cia402] serial is 1003");
  MasterBench& other = fresh_bench();
  other.ethercat.product = 403;
  ASSERT_OK(other.load());
  assert_refused(other, Status::kRefusedByRobot, "product (1018h:2) is 402, expected 403");
}

void the_serial_numbers_of_a_segment_are_told_until_the_file_has_them(void**) {
  cia402::assert_serials_are_told_until_stated([]() -> MasterBench& { return fresh_bench(); });
}

void an_eeprom_that_cannot_be_read_is_refused_with_the_reason(void**) {
  struct Row {
    std::uint16_t control;
    const char* words;
  };
  for (const Row& row :
       {Row{0x2000,
            "its EEPROM cannot be read at word 0008h: it does not acknowledge (NACK) (0502h "
            "is 2000h)"},
        Row{0x8000, "its EEPROM cannot be read at word 0008h: it stays busy (0502h is 8000h)"}}) {
    MasterBench& bench = fresh_bench();
    ASSERT_OK(bench.load());
    bench.hal.tamper = [&row](Frame& frame) {
      FrameReader reader(frame);
      Datagram datagram;
      const bool reads = reader.next(datagram) && datagram.command == Command::kFprd;
      if (reads && datagram.reg() == kEepromControlReg) put(datagram.data, row.control);
    };
    assert_refused(bench, Status::kRefusedByRobot, row.words);
  }
}

void mailbox_faults_are_named(void**) {
  MasterBench& bench = fresh_bench();
  bench.ethercat.sdo_ms = 50;
  ASSERT_OK(bench.load());
  bench.add(drives::FaultKind::kSdoSilence, 5, 0x6502);
  assert_refused(bench, Status::kBusTimeout,
                 "joint 5 (slave 5): object 6502h:0: no answer within 50 ms");
  MasterBench& other = fresh_bench();
  ASSERT_OK(other.load());
  other.add(drives::FaultKind::kSdoAbort, 2, 0x6502);
  assert_refused(other, Status::kRefusedByRobot,
                 "joint 2 (slave 2): supported modes: object 6502h:0: general");
}

/// Writes are refused, and what the drive has by itself is enough.
void a_drive_whose_mapping_cannot_be_read_is_refused(void**) {
  MasterBench& bench = fresh_bench();
  ASSERT_OK(bench.load());
  drives::Fault fault;
  fault.kind = drives::FaultKind::kSdoAbort;
  fault.value = 0x1C12;
  fault.node = 4;
  fault.abort = 0x06010002;
  assert_true(bench.hal.line.add(fault));
  // Reads of it are refused too, so that nothing can be known.
  assert_refused(bench, Status::kRefusedByRobot, "joint 4 (slave 4): PDOs: object 1C12h:0");
}

void settings_that_cannot_be_are_refused(void**) {
  MasterBench& bench = fresh_bench();
  bench.ethercat.slave[3] = 3;
  ASSERT_STATUS(bench.load(), Status::kBadValue);
  assert_non_null(std::strstr(bench.hal.trouble().c_str(), "slave of joint 4 is 3"));
  MasterBench& other = fresh_bench();
  other.ethercat.watchdog_ms = 2;
  ASSERT_STATUS(other.load(), Status::kBadValue);
  MasterBench& none = fresh_bench();
  none.ethercat.interface = Value("");
  ASSERT_STATUS(none.load(), Status::kMissingKey);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(seven_drives_are_brought_to_op_and_none_is_enabled),
      cmocka_unit_test(every_mode_gets_its_mapping),
      cmocka_unit_test(pdos_are_mapped_while_they_are_not_assigned),
      cmocka_unit_test(slaves_may_be_in_any_order_and_state),
      cmocka_unit_test(a_second_start_up_follows_a_first_one),
      cmocka_unit_test(lost_frames_of_the_start_up_are_sent_again),
      cmocka_unit_test(a_start_up_that_is_given_up_leaves_the_slaves_in_init),
      cmocka_unit_test(slaves_that_are_too_few_are_not_touched),
      cmocka_unit_test(a_segment_of_another_length_is_refused),
      cmocka_unit_test(a_wire_that_falls_silent_is_named_wherever_the_start_up_is),
      cmocka_unit_test(a_wrong_drive_is_named_with_what_it_says),
      cmocka_unit_test(the_serial_numbers_of_a_segment_are_told_until_the_file_has_them),
      cmocka_unit_test(an_eeprom_that_cannot_be_read_is_refused_with_the_reason),
      cmocka_unit_test(mailbox_faults_are_named),
      cmocka_unit_test(a_drive_whose_mapping_cannot_be_read_is_refused),
      cmocka_unit_test(settings_that_cannot_be_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
