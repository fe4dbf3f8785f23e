// Trajectory files of the tool tip: written numbers come back, mistakes are refused with their
// place.
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <random>

#include "gateway/trajectory/trajectory_columns.hpp"
#include "gateway/trajectory/trajectory_reader.hpp"
#include "tests/gateway/trajectory/column_order.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr int kColumns = 26, kCapacity = 50;
constexpr std::array<const char*, kColumns> kHeaders = {"time_s",
                                                        "x_m",
                                                        "y_m",
                                                        "z_m",
                                                        "qw",
                                                        "qx",
                                                        "qy",
                                                        "qz",
                                                        "vx_m_s",
                                                        "vy_m_s",
                                                        "vz_m_s",
                                                        "wx_rad_s",
                                                        "wy_rad_s",
                                                        "wz_rad_s",
                                                        "ax_m_s2",
                                                        "ay_m_s2",
                                                        "az_m_s2",
                                                        "alphax_rad_s2",
                                                        "alphay_rad_s2",
                                                        "alphaz_rad_s2",
                                                        "fx_N",
                                                        "fy_N",
                                                        "fz_N",
                                                        "mx_Nm",
                                                        "my_Nm",
                                                        "mz_Nm"};

std::array<Waypoint<TaskSpace>, kCapacity> storage, written;
Trajectory<TaskSpace> trajectory;
CsvError error;

/// A file of this process; each test that uses it writes it again.
const char* scratch() {
  static char path[64];
  std::snprintf(path, sizeof path, "/tmp/tactus-task-csv-%d.csv", static_cast<int>(getpid()));
  return path;
}

int remove_scratch(void**) {
  std::remove(scratch());
  return 0;
}

bool read() {
  trajectory = {};
  trajectory.waypoints = storage.data();
  trajectory.capacity = kCapacity;
  return read_trajectory(scratch(), false, trajectory, error);
}

bool read_text(std::string_view text) {
  std::FILE* file = std::fopen(scratch(), "wb");
  assert_non_null(file);
  std::fwrite(text.data(), 1, text.size(), file);
  std::fclose(file);
  return read();
}

/// The number of a column, in the order of kHeaders.
double& value_of(Waypoint<TaskSpace>& waypoint, int column) {
  TaskSpace::Point& point = waypoint.point;
  Eigen::Quaterniond& r = point.x.r;
  double* const orientation[] = {&r.w(), &r.x(), &r.y(), &r.z()};
  Vector6* const vectors[] = {&point.v, &point.a, &point.h};
  return column == 0  ? waypoint.time_s
         : column < 4 ? point.x.p[column - 1]
         : column < 8 ? *orientation[column - 4]
                      : (*vectors[(column - 8) / 6])[(column - 8) % 6];
}

/// Numbers of every magnitude, so that every bit of them counts.
void randomize(std::mt19937_64& random) {
  for (Waypoint<TaskSpace>& waypoint : written) {
    for (int c = 0; c < kColumns; ++c)
      value_of(waypoint, c) =
          std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 100) - 80) *
          (random() % 2 == 0 ? 1.0 : -1.0);
  }
}

/// Writes the random waypoints with the columns in the given order, and reads them back.
bool write_and_read(const int* columns, int width) {
  std::FILE* file = std::fopen(scratch(), "wb");
  assert_non_null(file);
  for (int c = 0; c < width; ++c)
    std::fprintf(file, "%s%s", c > 0 ? "," : "", kHeaders[static_cast<std::size_t>(columns[c])]);
  for (Waypoint<TaskSpace>& waypoint : written) {
    for (int c = 0; c < width; ++c)
      std::fprintf(file, "%c%.17g", c > 0 ? ',' : '\n', value_of(waypoint, columns[c]));
  }
  std::fputc('\n', file);
  std::fclose(file);
  return read();
}

/// Reads a file of one waypoint with these columns, whose numbers count from 0. Returns null if it
/// is accepted, else the message.
const char* refusal(const char* columns) {
  static char text[1024];
  static PlacedMessage message;
  std::size_t size = static_cast<std::size_t>(std::snprintf(text, sizeof text, "%s\n", columns));
  int cells = 1;
  for (const char* c = columns; *c != '\0'; ++c) cells += *c == ',';
  for (int i = 0; i < cells; ++i)
    size += static_cast<std::size_t>(
        std::snprintf(text + size, sizeof text - size, "%s%d", i > 0 ? "," : "", i));
  if (read_text({text, size})) return nullptr;
  message = error.message();
  return message.c_str();
}

constexpr const char* kPose = "time_s,x_m,y_m,z_m,qw,qx,qy,qz";

/// Reads a file with the pose and these columns.
const char* refusal_with(const char* columns) {
  static char all[768];
  std::snprintf(all, sizeof all, "%s,%s", kPose, columns);
  return refusal(all);
}

// Proves CSV-1, CSV-3.

void columns_in_any_order_come_back_to_the_last_bit(void**) {
  std::mt19937_64 random(4180);
  for (int trial = 0; trial < 20; ++trial) {
    const auto columns = any_order<kColumns>(random);
    randomize(random);
    assert_true(write_and_read(columns.data(), kColumns));
    assert_int_equal(trajectory.count, kCapacity);
    assert_int_equal(trajectory.fields, kVelocityField | kAccelerationField | kEffortField);
    for (std::size_t i = 0; i < written.size(); ++i) {
      for (int c = 0; c < kColumns; ++c)
        assert_memory_equal(&value_of(written[i], c), &value_of(storage[i], c), sizeof(double));
    }
  }
}

// Proves CSV-1.

void a_group_left_out_is_zero_and_not_among_the_fields(void**) {
  assert_null(refusal(kPose));
  assert_int_equal(trajectory.fields, 0);
  const TaskSpace::Point& point = trajectory.waypoints[0].point;
  assert_true(point.x.p == Vector3(1.0, 2.0, 3.0));
  assert_true(point.x.r.w() == 4.0 && point.x.r.vec() == Vector3(5.0, 6.0, 7.0));
  assert_true(point.idle());
  assert_null(refusal_with("fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm"));
  assert_int_equal(trajectory.fields, kEffortField);
  assert_true(trajectory.waypoints[0].point.h[5] == 13.0);
}

// Proves CSV-2.

void a_column_left_out_of_a_group_is_named_with_its_group(void**) {
  assert_string_equal(refusal("x_m,y_m,z_m,qw,qx,qy,qz"), "1: time: 0 columns, expected 1");
  assert_string_equal(refusal("time_s,x_m,z_m,qw,qx,qy,qz"), "1: position: 2 columns, expected 3");
  assert_string_equal(refusal("time_s,x_m,y_m,z_m,qw,qx,qy"),
                      "1: orientation: 3 columns, expected 4");
  assert_string_equal(refusal("time_s,x_m,y_m,z_m"), "1: orientation: 0 columns, expected 4");
  assert_string_equal(refusal_with("vx_m_s,vy_m_s,vz_m_s"), "1: velocity: 3 columns, expected 6");
  assert_string_equal(refusal_with("fx_N"), "1: wrench: 1 column, expected 6");
  assert_string_equal(
      refusal_with("ax_m_s2,ay_m_s2,az_m_s2,alphax_rad_s2,alphay_rad_s2,alphaz_rad_s2"),
      "1: acceleration is given without velocity");
}

void a_column_twice_is_refused_with_the_place_of_the_first(void**) {
  assert_string_equal(refusal("time_s,x_m,y_m,x_m,qw,qx,qy,qz"),
                      "1:4: x_m: already given in column 2");
  assert_string_equal(refusal("time_s,time_s"), "1:2: time_s: already given in column 1");
  assert_string_equal(refusal_with("qx"), "1:9: qx: already given in column 6");
}

void an_unknown_column_is_refused_with_those_there_are(void**) {
  constexpr const char* kForms[] = {"q1_rad", "x_cm",    "X_m",    "qw_1",
                                    "fx_n",   "dfx_N_s", "wx_rad", ""};
  for (const char* form : kForms) {
    char columns[64], expected[384];
    std::snprintf(columns, sizeof columns, "time_s,%s,y_m", form);
    std::snprintf(expected, sizeof expected,
                  "1:2: %s%sunknown column; expected one of time_s, x_m y_m z_m, qw qx qy qz, "
                  "vx_m_s .. wz_rad_s, ax_m_s2 .. alphaz_rad_s2, fx_N .. mz_Nm; or with "
                  "deg, mm, ms",
                  form, *form == '\0' ? "" : ": ");
    assert_string_equal(refusal(columns), expected);
  }
}

void a_cell_that_is_no_finite_number_is_refused_with_its_column(void**) {
  char text[256];
  for (const char* bad : {"nan", "inf", "1e999", "1m", "0x1"}) {
    std::snprintf(text, sizeof text, "%s\n0,1,2,3,1,0,%s,0\n", kPose, bad);
    assert_false(read_text(text));
    char expected[128];
    std::snprintf(expected, sizeof expected,
                  "2:7: qy: '%s' is not a finite number; write a number such as -0.5", bad);
    assert_string_equal(error.message().c_str(), expected);
  }
  std::snprintf(text, sizeof text, "%s\n0,1,2,3,1,0,,0\n", kPose);
  assert_false(read_text(text));
  assert_string_equal(error.message().c_str(), "2:7: qy: the cell is empty");
}

// Proves CSV-11.

/// A log has poses in the base frame, whatever frame the pipeline names for its trajectory.
void a_log_gives_pose_twist_and_wrench_in_the_base_frame(void**) {
  std::FILE* file = std::fopen(scratch(), "wb");
  assert_non_null(file);
  std::fputs(
      "time_s,model.x_x,t.x_d_x,t.x_d_y,t.x_d_z,t.x_d_qw,t.x_d_qx,t.x_d_qy,t.x_d_qz,t.v_d_vx,"
      "t.v_d_vy,t.v_d_vz,t.v_d_wx,t.v_d_wy,t.v_d_wz,t.h_d_fx,t.h_d_fy,t.h_d_fz,t.h_d_mx,"
      "t.h_d_my,t.h_d_mz,t.dh_d_dfx\n"
      "2,99,0.1,0.2,0.3,0,1,0,0,1,2,3,4,5,6,7,8,9,10,11,12,99\n",
      file);
  std::fclose(file);
  const Pose frame;
  trajectory = {};
  trajectory.waypoints = storage.data();
  trajectory.capacity = kCapacity;
  trajectory.header = {&frame, &frame};
  assert_true(read_trajectory(scratch(), false, trajectory, error));
  assert_true(trajectory.header.motion == nullptr && trajectory.header.wrench == nullptr);
  assert_int_equal(trajectory.fields, kVelocityField | kEffortField);
  const TaskSpace::Point& point = storage[0].point;
  assert_true(point.x.p == Vector3(0.1, 0.2, 0.3) && point.x.r.x() == 1.0 && point.x.r.w() == 0.0);
  for (int i = 0; i < 6; ++i) assert_true(point.v[i] == 1.0 + i && point.h[i] == 7.0 + i);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(columns_in_any_order_come_back_to_the_last_bit),
      cmocka_unit_test(a_group_left_out_is_zero_and_not_among_the_fields),
      cmocka_unit_test(a_column_left_out_of_a_group_is_named_with_its_group),
      cmocka_unit_test(a_column_twice_is_refused_with_the_place_of_the_first),
      cmocka_unit_test(an_unknown_column_is_refused_with_those_there_are),
      cmocka_unit_test(a_cell_that_is_no_finite_number_is_refused_with_its_column),
      cmocka_unit_test(a_log_gives_pose_twist_and_wrench_in_the_base_frame),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_scratch);
}
