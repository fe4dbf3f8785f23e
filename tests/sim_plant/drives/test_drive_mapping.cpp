// Which PDO parameters and mappings an emulated drive accepts, and when.
#include "tests/sim_plant/drives/drives_bench.hpp"

namespace tactus::drives {
namespace {

// Proves DRV-1.
void a_mapping_is_refused_with_the_code_of_the_standard(void**) {
  struct Row {
    unsigned record, entry, abort;
  };
  DrivesBench& bench = booted();
  bench.put(1, 0x1400, 1, 0x80000201LL, 4);
  bench.put(1, 0x1800, 1, 0x80000181LL, 4);
  bench.put(1, 0x1600, 0, 0, 1);
  bench.put(1, 0x1A00, 0, 0, 1);
  for (const Row& row : {Row{0x1600, 0x5FFF0010, 0x06020000},     // no object
                         Row{0x1600, 0x60400110, 0x06090011},     // no sub-index
                         Row{0x1600, 0x60410010, 0x06040041},     // read-only in an RPDO
                         Row{0x1A00, 0x60720010, 0x06040041},     // not for a TPDO
                         Row{0x1600, 0x10170010, 0x06040041},     // not mappable at all
                         Row{0x1600, 0x60710020, 0x06040041},     // wrong length
                         Row{0x1600, 0x00060008, 0x06040041},     // a dummy of wrong length
                         Row{0x1A00, 0x00060010, 0x06040041}}) {  // a dummy in a TPDO
    const std::uint32_t abort = bench.write(1, row.record, 1, row.entry, 4);
    if (abort != row.abort) print_error("%08X: %08X\n", row.entry, abort);
    assert_int_equal(abort, row.abort);
  }
  bench.put(1, 0x1600, 1, 0x60400010, 4);
  bench.put(1, 0x1600, 2, 0x607A0020, 4);
  bench.put(1, 0x1600, 3, 0x60FF0020, 4);
  assert_int_equal(bench.write(1, 0x1600, 0, 3, 1), 0x06040042);  // ten bytes
  assert_int_equal(bench.write(1, 0x1600, 0, 65, 1), 0x06090031);
  assert_int_equal(bench.write(1, 0x1600, 0, 4, 1), 0x06020000);  // the fourth is empty
  bench.put(1, 0x1600, 0, 2, 1);
  assert_int_equal(bench.write(1, 0x1600, 1, 0x60710010, 4), 0x08000022);  // sub 0 is not 0
}

void a_pdo_changes_only_while_it_is_invalid_and_not_in_operation(void**) {
  DrivesBench& bench = booted();
  assert_int_equal(bench.write(1, 0x1600, 0, 0, 1), 0x08000022);
  assert_int_equal(bench.write(1, 0x1400, 1, 0x222, 4), 0x08000022);
  assert_int_equal(bench.write(1, 0x1800, 3, 10, 2), 0x08000022);
  bench.put(1, 0x1400, 1, 0x80000222LL, 4);
  bench.put(1, 0x1600, 0, 0, 1);
  bench.start();
  assert_int_equal(bench.write(1, 0x1600, 0, 1, 1), 0x08000022);
  assert_int_equal(bench.write(1, 0x1400, 1, 0x222, 4), 0x08000022);
  bench.send(0x000, {0x80, 0x00});
  bench.put(1, 0x1600, 0, 1, 1);
  bench.put(1, 0x1400, 1, 0x222, 4);
}

void reserved_identifiers_and_types_are_refused(void**) {
  DrivesBench& bench = booted();
  bench.put(1, 0x1400, 1, 0x80000201LL, 4);
  for (const unsigned id : {0x000U, 0x07FU, 0x101U, 0x180U, 0x5FFU, 0x67FU, 0x701U, 0x7FFU})
    assert_int_equal(bench.write(1, 0x1400, 1, id, 4), 0x06090030);
  assert_int_equal(bench.write(1, 0x1400, 1, 0x20000201, 4), 0x06090030);  // 29 bits
  for (const unsigned type : {241U, 251U, 252U, 253U})
    assert_int_equal(bench.write(1, 0x1400, 2, type, 1), 0x06090030);
  bench.put(1, 0x1800, 2, 252, 1);
  assert_int_equal(bench.write(1, 0x1800, 2, 251, 1), 0x06090030);
}

void a_broadcast_command_is_shared_with_dummies(void**) {
  DrivesBench& bench = booted();
  bench.map(1, 0x1401, 0x220, 1, {0x60710010, 0x00070020, 0x00060010});
  bench.map(2, 0x1401, 0x220, 1, {0x00060010, 0x60710010, 0x00070020});
  bench.map(3, 0x1401, 0x220, 1, {0x00070020, 0x60710010, 0x00060010});
  bench.start();
  bench.send(0x220, {0x11, 0x01, 0x22, 0x02, 0x33, 0x03, 0x44, 0x04});
  bench.sync_cycle();
  assert_int_equal(bench.get(1, 0x6071, 0), 0x0111);
  assert_int_equal(bench.get(2, 0x6071, 0), 0x0222);
  assert_int_equal(bench.get(3, 0x6071, 0), 0x0333);
}

void can_fd_carries_long_pdos(void**) {
  DriveArmSettings settings = one_bus();
  settings.fd = true;
  DrivesBench& bench = booted(settings);
  bench.map(1, 0x1800, 0x181, 1, {0x60410010, 0x60640020, 0x606C0020, 0x60770010});
  bench.map(2, 0x1800, 0x182, 1, {0x60410010, 0x60640020, 0x606C0020, 0x60770010, 0x60740010});
  // Controlword and torque of seven drives, 28 bytes in a frame of 32; drive 2 has bytes 4 to 7.
  bench.map(2, 0x1400, 0x200, 1,
            {0x00070020, 0x60400010, 0x60710010, 0x00070020, 0x00070020, 0x00070020, 0x00070020,
             0x00070020});
  bench.start();
  can::CanFrame command = make_frame(0x200, {0, 0, 0, 0, 0x06, 0x00, 0x39, 0x05});
  command.fd = true;
  command.size = 32;
  bench.arm.receive(0, command, bench.now_ns);
  bench.sync_cycle();
  assert_true(bench.take(0x181));
  assert_int_equal(bench.frame.size, 12);
  assert_true(bench.frame.fd);
  assert_true(bench.take(0x182));
  assert_int_equal(bench.frame.size, 16);  // 14 bytes, padded
  assert_int_equal(bench.frame.data[0], 0x31);
  bench.expect_nothing(0x082);
  assert_int_equal(bench.get(2, 0x6071, 0), 0x0539);
}

}  // namespace
}  // namespace tactus::drives

int main() {
  using namespace tactus::drives;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_mapping_is_refused_with_the_code_of_the_standard),
      cmocka_unit_test(a_pdo_changes_only_while_it_is_invalid_and_not_in_operation),
      cmocka_unit_test(reserved_identifiers_and_types_are_refused),
      cmocka_unit_test(a_broadcast_command_is_shared_with_dummies),
      cmocka_unit_test(can_fd_carries_long_pdos),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
