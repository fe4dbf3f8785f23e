// The lines `sdo = ...` of [cia402] over EtherCAT.
#include "tests/hal/cia402/line_cases.hpp"
#include "tests/hal/ethercat/master_bench.hpp"

namespace tactus::ethercat {
namespace {

struct LineWire {
  using Bench = MasterBench;
  static Bench& fresh() { return fresh_bench(); }
  static const drives::Dictionary& dictionary(Bench& bench, int joint) {
    return bench.hal.line.slave(joint).dictionary();
  }
};

// Proves ECAT-20.
void drives_are_left_as_the_lines_say_or_refused(void**) {
  cia402::LineCases<LineWire>::try_all();
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {cmocka_unit_test(drives_are_left_as_the_lines_say_or_refused)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
