// The lines `sdo = ...` of [cia402] over EtherCAT.
#include "tests/cia402/line_cases.hpp"
#include "tests/ethercat/master_bench.hpp"

namespace tactus::ethercat {
namespace {

struct LineWire {
  using Bench = MasterBench;
  static Bench& fresh() { return fresh_bench(); }
  static const drives::Dictionary& dictionary(Bench& bench, int joint) {
    return bench.hal.line.slave(joint).dictionary();
  }
};

using Cases = cia402::LineCases<LineWire>;

// Proves ECAT-20.

void drives_are_left_as_the_lines_say_and_written_where_they_differ(void**) {
  Cases::leave_what_they_say();
}

void the_drive_of_another_joint_is_not_written_to(void**) {
  Cases::spare_the_drive_of_another_joint();
}

void what_a_line_sets_is_what_is_judged(void**) {
  Cases::set_what_is_judged();
}

void a_line_that_a_drive_does_not_take_is_refused_with_what_it_said(void**) {
  Cases::refuse_what_a_drive_does_not_take();
}

void a_drive_has_its_own_time_to_store_and_it_is_told_which_did(void**) {
  Cases::store_in_its_own_time();
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(drives_are_left_as_the_lines_say_and_written_where_they_differ),
      cmocka_unit_test(the_drive_of_another_joint_is_not_written_to),
      cmocka_unit_test(what_a_line_sets_is_what_is_judged),
      cmocka_unit_test(a_line_that_a_drive_does_not_take_is_refused_with_what_it_said),
      cmocka_unit_test(a_drive_has_its_own_time_to_store_and_it_is_told_which_did),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
