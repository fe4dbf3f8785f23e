// Tests the forms of a trajectory file: units other than SI's, separators other than commas, and
// the log of a run.
#include <algorithm>
#include <cstring>
#include <string>

#include "tests/gateway/trajectory/csv_bench.hpp"

namespace tactus {
namespace {

// Proves CSV-4.

void degrees_and_milliseconds_are_converted(void**) {
  assert_true(
      read_text("time_ms,q1_deg,q2_deg,q3_deg,q4_rad,q5_rad,q6_rad,q7_rad,dq1_deg_s,"
                "dq2_rad_s,dq3_rad_s,dq4_rad_s,dq5_rad_s,dq6_rad_s,dq7_rad_s\n"
                "250,180,-90,1e-3,-2,0,1,0.5,36,0,0,0,0,0,0\n"));
  const Waypoint<JointSpace>& read = storage[0];
  ASSERT_NEAR(read.time_s, 0.25, 1e-16);
  const double expected[] = {3.14159265358979312, -1.57079632679489656, 1.74532925199432958e-5};
  for (int i = 0; i < 3; ++i) ASSERT_NEAR(read.point.q[i], expected[i], 1e-15);
  ASSERT_NEAR(read.point.dq[0], 0.628318530717958648, 1e-15);
  assert_true(read.point.q[3] == -2.0 && read.point.q[6] == 0.5);
  assert_false(read_text("time_s,q1_rad,q1_deg\n"));  // one column, twice
}

void semicolons_and_tabs_separate_too(void**) {
  for (const char separator : {';', '\t'}) {
    char text[160] =
        "time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,q7_rad\n"
        "1,0, -0.5,0,-2 ,0,1.5,0.75\n";
    std::replace(text, text + std::strlen(text), ',', separator);
    assert_true(read_text(text));
    const double expected[] = {0.0, -0.5, 0.0, -2.0, 0.0, 1.5, 0.75};
    for (int i = 0; i < kDof; ++i) assert_true(storage[0].point.q[i] == expected[i]);
  }
  assert_false(
      read_text("time_s\tq1_rad\tq2_rad\tq3_rad\tq4_rad\tq5_rad\tq6_rad\tq7_rad\n"
                "\t0\t0\t0\t-2\t0\t1\t0\n"));
  assert_string_equal(g_error.message().c_str(), "2:1: time_s: the cell is empty");
}

// Proves CSV-11.

void of_a_log_the_columns_of_the_reference_are_read_and_no_others(void**) {
  constexpr const char* kLog =
      "time_s,robot.q_1,ms_mm.dq_d_1,j.q_d_1,j.q_d_2,j.q_d_3,j.q_d_4,j.q_d_5,j.q_d_6,j.q_d_7,"
      "ms_mm.dq_d_2,j.dq_d_3,j.dq_d_4,j.dq_d_5,j.dq_d_6,j.dq_d_7,pd.tau_1,j.x_d_x,ac.limited_on\n";
  std::string text(kLog);
  assert_true(read_text(text + "0.5,nan,8,1,2,3,4,5,6,7,9,10,11,12,13,14,x,,1\n"));
  const Waypoint<JointSpace>& read = storage[0];
  assert_true(read.time_s == 0.5 && g_trajectory.fields == kVelocityField);
  for (int i = 0; i < kDof; ++i)
    assert_true(read.point.q[i] == 1.0 + i && read.point.dq[i] == 8.0 + i);
  assert_false(read_text(text + "0.5,0,8,1,2,3,4,5,6,z,9,10,11,12,13,14,0,0,1\n"));
  assert_string_equal(g_error.message().c_str(),
                      "2:10: j.q_d_7: 'z' is not a finite number; write a number such as -0.5");
  assert_false(read_text(text + "0.5,0,8\n"));
  assert_string_equal(g_error.message().c_str(), "2: 3 cells, but the header has 19 columns");
  assert_false(read_text("time_s,robot.q_1,model.x_x\n0,0,0\n"));
  assert_string_equal(g_error.message().c_str(),
                      "1: position: 0 columns, expected 7; the log has no reference: name it in "
                      "[recorder] signals, jrg.q_d for example");
  assert_false(read_text("time_s,a.q_d_1,b.q_d_1\n0,0,0\n"));
  assert_string_equal(g_error.message().c_str(), "1:3: b.q_d_1: already given in column 2");
}

void every_output_of_a_reference_is_read_from_a_log(void**) {
  std::string header("time_s"), row("0");
  int number = 0;
  for (const char* output : {"q_d", "dq_d", "ddq_d", "tau_d"})
    for (int joint = 1; joint <= kDof; ++joint) {
      header += "," + (std::string("jrg.") + output) + "_" + std::to_string(joint);
      row += "," + std::to_string(++number);
    }
  assert_true(read_text(header + "\n" + row + "\n"));
  const JointSpace::Point& point = storage[0].point;
  assert_true(point.q[0] == 1.0 && point.dq[0] == kDof + 1.0 && point.ddq[0] == 2.0 * kDof + 1.0);
  assert_true(point.tau[kDof - 1] == 4.0 * kDof);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(degrees_and_milliseconds_are_converted),
      cmocka_unit_test(semicolons_and_tabs_separate_too),
      cmocka_unit_test(of_a_log_the_columns_of_the_reference_are_read_and_no_others),
      cmocka_unit_test(every_output_of_a_reference_is_read_from_a_log),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_csv_file);
}
