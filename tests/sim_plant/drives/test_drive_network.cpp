// Network management, heartbeats and emergencies of an emulated drive.
#include "tests/sim_plant/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

// Proves DRV-3.
void a_drive_says_boot_up_and_is_pre_operational(void**) {
  DrivesBench& bench = fresh();
  bench.run_ms(9);
  assert_false(bench.take());
  bench.run_ms(1);
  bench.expect(0x701, {0x00});
  bench.expect(0x707, {0x00});
  bench.put(1, 0x1017, 0, 10, 2);
  bench.run_ms(10);
  bench.expect(0x701, {0x7F});
}

void every_command_of_network_management_is_obeyed(void**) {
  struct Row {
    unsigned command, heartbeat;
  };
  DrivesBench& bench = booted();
  bench.put(3, 0x1017, 0, 10, 2);
  for (const Row& row :
       {Row{0x01, 0x05}, Row{0x80, 0x7F}, Row{0x02, 0x04}, Row{0x01, 0x05}, Row{0x02, 0x04}}) {
    bench.send(0x000, {row.command, 0x03});
    bench.run_ms(10);
    bench.expect(0x703, {row.heartbeat});
  }
}

void a_command_to_node_zero_is_for_all_and_to_another_for_none(void**) {
  DrivesBench& bench = booted();
  bench.send(0x000, {0x01, 0x05});
  assert_false(bench.arm.node(0).operational());
  assert_true(bench.arm.node(4).operational());
  bench.send(0x000, {0x01, 0x00});
  for (int i = 0; i < kDof; ++i) assert_true(bench.arm.node(i).operational());
  bench.send(0x000, {0x80});  // without a node it is no command
  assert_true(bench.arm.node(0).operational());
}

void a_reset_gives_the_defaults_and_boot_up(void**) {
  DrivesBench& bench = booted();
  for (const unsigned command : {0x82U, 0x81U}) {
    bench.put(1, 0x1017, 0, 10, 2);
    bench.put(1, 0x6085, 0, 777, 4);
    bench.send(0x000, {command, 0x01});
    assert_int_equal(bench.read(1, 0x1000, 0), 0xFFFFFFFF);
    bench.run_ms(10);
    bench.expect(0x701, {0x00});
    assert_int_equal(bench.get(1, 0x1017, 0), 0);
    // Only a reset of the node is for the drive's own objects too.
    assert_int_equal(bench.get(1, 0x6085, 0) == 777, command == 0x82);
  }
  assert_int_equal(bench.get(5, 0x6076, 0), 500);
  bench.send(0x000, {0x81, 0x00});
  bench.boot();
  assert_int_equal(bench.get(5, 0x6076, 0), 500);
}

void the_heartbeat_keeps_its_period(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1017, 0, 7, 2);
  bench.run_ms(71);
  int count = 0;
  while (bench.take(0x701)) ++count;
  assert_int_equal(count, 10);
}

void node_guarding_is_answered_with_a_toggle(void**) {
  DrivesBench& bench = booted();
  can::CanFrame request = make_frame(0x701, {});
  request.remote = true;
  bench.arm.receive(0, request, bench.now_ns);
  bench.expect(0x701, {0x7F});
  bench.arm.receive(0, request, bench.now_ns);
  bench.expect(0x701, {0xFF});
}

/// Node 1 watches node 127 for 30 ms, and has heard it once.
DrivesBench& watching(unsigned behaviour, unsigned reaction) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1016, 1, 0x007F001E, 4);
  bench.put(1, 0x1029, 1, behaviour, 1);
  bench.put(1, 0x6007, 0, reaction, 2);
  bench.put(1, 0x6060, 0, 10, 1);
  bench.send(0x000, {0x01, 0x00});
  for (const unsigned word : {6U, 7U, 15U}) bench.put(1, 0x6040, 0, word, 2);
  bench.run_ms(200);
  bench.send(0x77F, {0x05});
  bench.run_ms(29);
  bench.expect_nothing(0x081);
  return bench;
}

void a_heartbeat_that_was_never_heard_is_not_missed(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1016, 1, 0x007F001E, 4);
  bench.run_ms(200);
  bench.expect_nothing(0x081);
}

void a_lost_heartbeat_is_an_emergency_and_a_fault(void**) {
  DrivesBench& bench = watching(0, 1);
  bench.run_ms(1);
  bench.expect(0x081, {0x30, 0x81, 0x11, 0, 0, 0, 0, 0});
  assert_int_equal(static_cast<int>(bench.arm.node(0).nmt()), 0x7F);
  bench.run_ms(200);
  assert_int_equal(bench.get(1, 0x6041, 0) & 0x4F, 0x08);
  assert_int_equal(bench.get(1, 0x603F, 0), 0x8130);
  assert_int_equal(bench.get(1, 0x1001, 0), 0x11);
  assert_int_equal(bench.get(1, 0x1003, 0), 1);
  assert_int_equal(bench.get(1, 0x1003, 1), 0x8130);
  bench.put(1, 0x6040, 0, 0x80, 2);  // the cause is still there
  assert_int_equal(bench.get(1, 0x6041, 0) & 0x4F, 0x08);
  bench.send(0x77F, {0x05});
  bench.expect(0x081, {0x00, 0x00, 0x00, 0, 0, 0, 0, 0});
  bench.put(1, 0x6040, 0, 0x00, 2);
  bench.put(1, 0x6040, 0, 0x80, 2);
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0250);
  assert_int_equal(bench.get(1, 0x603F, 0), 0);
  bench.put(1, 0x1003, 0, 0, 1);
  assert_int_equal(bench.read(1, 0x1003, 1), 0x08000024);
}

void the_reaction_to_a_lost_heartbeat_is_that_of_the_options(void**) {
  struct Row {
    unsigned behaviour, reaction, nmt, status;
  };
  for (const Row& row : {Row{0, 0, 0x7F, 0x27}, Row{1, 2, 0x05, 0x40}, Row{1, 3, 0x05, 0x07},
                         Row{2, 1, 0x04, 0x0F}}) {
    DrivesBench& bench = watching(row.behaviour, row.reaction);
    bench.run_ms(1);
    assert_int_equal(static_cast<int>(bench.arm.node(0).nmt()), row.nmt);
    const unsigned status = bench.arm.node(0).axis().statusword();
    assert_int_equal(status & (row.status == 0x0F || row.status == 0x40 ? 0x4F : 0x6F), row.status);
  }
}

void stopping_a_node_that_moves_is_the_loss_of_its_master(void**) {
  DrivesBench& bench = watching(1, 1);
  bench.send(0x000, {0x02, 0x01});
  assert_int_equal(bench.arm.node(0).axis().statusword() & 0x4F, 0x0F);
  bench.run_ms(300);
  assert_int_equal(bench.arm.node(0).axis().statusword() & 0x4F, 0x08);
}

void the_history_keeps_the_newest_error_first(void**) {
  DrivesBench& bench = booted();
  assert_true(bench.arm.add({1, FaultKind::kEmergency, 1, 100, 1.0, 0x2310}));
  assert_true(bench.arm.add({1, FaultKind::kEmergency, 2, 100, 1.0, 0x4310}));
  bench.sync();
  bench.expect(0x081, {0x10, 0x23, 0x03, 0, 0, 0, 0, 0});
  bench.sync();
  bench.expect(0x081, {0x10, 0x43, 0x0B, 0, 0, 0, 0, 0});
  assert_int_equal(bench.get(1, 0x1003, 0), 2);
  assert_int_equal(bench.get(1, 0x1003, 1), 0x4310);
  assert_int_equal(bench.get(1, 0x1003, 2), 0x2310);
  bench.put(1, 0x6040, 0, 0x80, 2);
  // Both have gone, one after the other.
  assert_int_equal(bench.get(1, 0x1001, 0), 0);
  assert_int_equal(bench.get(1, 0x6041, 0), 0x0250);
}

void an_emergency_can_be_switched_off(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1014, 0, 0x80000081LL, 4);
  assert_true(bench.arm.add({1, FaultKind::kEmergency, 1, 100, 1.0, 0x2310}));
  bench.sync();
  bench.expect_nothing(0x081);
  assert_int_equal(bench.get(1, 0x603F, 0), 0x2310);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_drive_says_boot_up_and_is_pre_operational),
      cmocka_unit_test(every_command_of_network_management_is_obeyed),
      cmocka_unit_test(a_command_to_node_zero_is_for_all_and_to_another_for_none),
      cmocka_unit_test(a_reset_gives_the_defaults_and_boot_up),
      cmocka_unit_test(the_heartbeat_keeps_its_period),
      cmocka_unit_test(node_guarding_is_answered_with_a_toggle),
      cmocka_unit_test(a_heartbeat_that_was_never_heard_is_not_missed),
      cmocka_unit_test(a_lost_heartbeat_is_an_emergency_and_a_fault),
      cmocka_unit_test(the_reaction_to_a_lost_heartbeat_is_that_of_the_options),
      cmocka_unit_test(stopping_a_node_that_moves_is_the_loss_of_its_master),
      cmocka_unit_test(the_history_keeps_the_newest_error_first),
      cmocka_unit_test(an_emergency_can_be_switched_off),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
