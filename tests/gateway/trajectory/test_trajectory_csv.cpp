// Trajectory files of the joints: written numbers come back, mistakes are refused with their place.
#include <cstdlib>
#include <random>

#include "gateway/trajectory/trajectory_columns.hpp"
#include "tests/gateway/trajectory/column_order.hpp"
#include "tests/gateway/trajectory/csv_bench.hpp"
#include "tests/support/cases.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr Fields kAllFields = kVelocityField | kAccelerationField | kEffortField;

std::array<Waypoint<JointSpace>, kCapacity> written;

/// Numbers of every magnitude, so that every bit of them counts.
void randomize(std::mt19937_64& random, int count) {
  const auto number = [&] {
    return std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 100) - 80) *
           (random() % 2 == 0 ? 1.0 : -1.0);
  };
  for (int i = 0; i < count; ++i) {
    Waypoint<JointSpace>& waypoint = written[static_cast<std::size_t>(i)];
    waypoint.time_s = number();
    for (int j = 0; j < kDof; ++j) {
      waypoint.point.q[j] = number();
      waypoint.point.dq[j] = number();
      waypoint.point.ddq[j] = number();
      waypoint.point.tau[j] = number();
    }
  }
}

double value_of(const Waypoint<JointSpace>& waypoint, int column) {
  const int group = (column - 1) / kDof, joint = (column - 1) % kDof;
  const JointSpace::Point& point = waypoint.point;
  return column == 0  ? waypoint.time_s
         : group == 0 ? point.q[joint]
         : group == 1 ? point.dq[joint]
         : group == 2 ? point.ddq[joint]
                      : point.tau[joint];
}

void write_header(std::FILE* file, int column, bool names) {
  constexpr const char* kGroups[][2] = {
      {"q", "rad"}, {"dq", "rad_s"}, {"ddq", "rad_s2"}, {"tau", "Nm"}};
  const auto& group = kGroups[(column - 1) / kDof];
  const auto joint = static_cast<std::size_t>((column - 1) % kDof);
  if (column == 0)
    std::fprintf(file, "time_s");
  else if (names)
    std::fprintf(file, "%s_%s_%s", group[0], Robot::kJointNames[joint], group[1]);
  else
    std::fprintf(file, "%s%zu_%s", group[0], joint + 1, group[1]);
}

/// Writes `count` waypoints with the columns in the given order, and reads them back.
bool write_and_read(const int* columns, int width, int count, bool names) {
  std::FILE* file = std::fopen(csv_file(), "wb");
  assert_non_null(file);
  for (int c = 0; c < width; ++c) {
    if (c > 0) std::fputc(',', file);
    write_header(file, columns[c], names);
  }
  for (int i = 0; i < count; ++i) {
    for (int c = 0; c < width; ++c)
      std::fprintf(file, "%c%.17g", c > 0 ? ',' : '\n',
                   value_of(written[static_cast<std::size_t>(i)], columns[c]));
  }
  std::fputc('\n', file);
  std::fclose(file);
  return read(csv_file());
}

void assert_same_bits(int count) {
  assert_int_equal(g_trajectory.count, count);
  for (int i = 0; i < count; ++i) {
    for (int c = 0; c <= 4 * kDof; ++c) {
      const double a = value_of(written[static_cast<std::size_t>(i)], c);
      const double b = value_of(g_trajectory.waypoints[i], c);
      assert_memory_equal(&a, &b, sizeof a);
    }
  }
}

// Proves CSV-1, CSV-3.

void columns_in_any_order_by_number_or_name_come_back_to_the_last_bit(void**) {
  constexpr int kColumns = 1 + 4 * kDof;
  std::mt19937_64 random(4180);
  for (int trial = 0; trial < 20; ++trial) {
    const auto columns = any_order<kColumns>(random);
    randomize(random, 50);
    assert_true(write_and_read(columns.data(), kColumns, 50, trial % 2 == 0));
    assert_same_bits(50);
    assert_int_equal(g_trajectory.fields, kAllFields);
  }
}

void a_trajectory_of_20001_waypoints_comes_back_whole_and_one_more_is_refused(void**) {
  constexpr int kColumns = 1 + 4 * kDof;
  int columns[kColumns];
  for (int c = 0; c < kColumns; ++c) columns[c] = c;
  std::mt19937_64 random(20001);
  randomize(random, kCapacity);
  assert_true(write_and_read(columns, kColumns, kCapacity, false));
  assert_same_bits(kCapacity);
  assert_false(read(csv_file(), kCapacity - 1));
  assert_string_equal(g_error.message().c_str(), "20002: too many waypoints; at most 20000 fit");
}

constexpr const char* kHeader = "time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,q7_rad";

// Proves CSV-1.

void a_group_left_out_is_zero_and_not_among_the_fields(void**) {
  char text[256];
  std::snprintf(text, sizeof text, "%s\n1,1,2,3,4,5,6,7\n", kHeader);
  assert_true(read_text(text));
  assert_int_equal(g_trajectory.count, 1);
  assert_int_equal(g_trajectory.fields, 0);
  const JointSpace::Point& point = g_trajectory.waypoints[0].point;
  assert_true(point.q[6] == 7.0);
  assert_true(point.dq.isZero(0.0) && point.ddq.isZero(0.0) && point.tau.isZero(0.0));
}

void line_ends_blanks_marks_and_comments_make_no_difference(void**) {
  for (const char* form :
       {"%s\n1,1,2,3,4,5,6,7\n2,1,2,3,4,5,6,7\n", "%s\n1,1,2,3,4,5,6,7\n2,1,2,3,4,5,6,7",
        "%s\r\n1,1,2,3,4,5,6,7\r\n2,1,2,3,4,5,6,7\r\n",
        "\xef\xbb\xbf%s\n+1 , 1,\t2,3,4,5,6,7\t\n 2,1,2,3,4,5,6,7 \n",
        "# Größe\n\n  # 機\n%s\n\n1,1e0,+2,3.,4,5,6,0.7e1\n#2\n \t\n2,1,2,3,4,5,6,7\n\n"}) {
    char text[256];
    std::snprintf(text, sizeof text, form, kHeader);
    assert_true(read_text(text));
    assert_int_equal(g_trajectory.count, 2);
    for (int c = 0; c <= kDof; ++c)
      assert_true(value_of(g_trajectory.waypoints[0], c) == (c == 0 ? 1.0 : c));
  }
}

// Proves CSV-2.

void every_case_with_a_mistake_is_refused_with_its_message(void**) {
  const int count = judge_cases("tests/refused/trajectories", [](const FileCase& file) {
    return !read(file.path.data()) && file.expects(g_error.message());
  });
  assert_true(count >= 63);
}

void what_is_no_file_is_refused_with_the_reason_of_the_system(void**) {
  assert_false(read("/tmp"));
  assert_string_equal(g_error.message().c_str(),
                      "Is a directory; give the path of a trajectory file");
  assert_false(read("tests/there_is_none.csv"));
  assert_string_equal(g_error.message().c_str(),
                      "No such file or directory; give the path of a trajectory file");
  assert_false(read_text(""));
  assert_string_equal(g_error.message().c_str(), "the file has no header");
}

void no_damage_crashes_the_reader_and_no_number_it_lets_pass_is_not_finite(void**) {
  constexpr std::uint64_t kSeed = 4180;
  std::mt19937_64 random(kSeed);
  char text[512];
  const auto size = static_cast<std::size_t>(
      std::snprintf(text, sizeof text, "%s\n1,1,2,3,4,5,6,7\n2,0.1,-0.2,3e-1,4,5,6,7\n", kHeader));
  int loaded = 0;
  for (int i = 0; i < 2'000; ++i) {
    char work[512];
    std::memcpy(work, text, size);
    for (auto n = random() % 3 + 1; n > 0; --n)
      work[random() % size] =
          random() % 2 == 0 ? "0123456789.,-+eEn\n#"[random() % 19] : static_cast<char>(random());
    const bool good = read_text({work, random() % 4 == 0 ? random() % size : size});
    loaded += good ? 1 : 0;
    assert_true(good || !g_error.reason.empty());
    for (int k = 0; good && k < g_trajectory.count; ++k)
      assert_true(g_trajectory.waypoints[k].point.finite() &&
                  std::isfinite(g_trajectory.waypoints[k].time_s));
  }
  assert_true(loaded > 20);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(columns_in_any_order_by_number_or_name_come_back_to_the_last_bit),
      cmocka_unit_test(a_trajectory_of_20001_waypoints_comes_back_whole_and_one_more_is_refused),
      cmocka_unit_test(a_group_left_out_is_zero_and_not_among_the_fields),
      cmocka_unit_test(line_ends_blanks_marks_and_comments_make_no_difference),
      cmocka_unit_test(every_case_with_a_mistake_is_refused_with_its_message),
      cmocka_unit_test(what_is_no_file_is_refused_with_the_reason_of_the_system),
      cmocka_unit_test(no_damage_crashes_the_reader_and_no_number_it_lets_pass_is_not_finite),
  };
  return cmocka_run_group_tests(tests, nullptr, remove_csv_file);
}
