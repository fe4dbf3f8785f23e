// Tests runs of trajectory files that are longer than the store.
#include <string>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr int kRows = 40'000;  // 32 768 fit

/// Writes a slow swing of joint 1, whose waypoint `wild`, if it has one, leaves the range.
Line write_long(const char* name, double spacing_s, int wild = -1) {
  const Line path = in_folder(name);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  assert_non_null(file);
  std::fputs(kHeader, file);
  for (int i = 0; i < kRows; ++i) {
    const double x = 0.5 * (1.0 - std::cos(2.0 * 3.14159265358979323846 * i / (kRows - 1)));
    std::fprintf(file, "%.7f,%.9f,-0.785398,0,-2.356194,0,1.570796,0.785398\n",
                 spacing_s * (i + 320), i == wild ? 9.0 : 0.1 * x);
  }
  std::fclose(file);
  return path;
}

Line quiet_pipeline() {
  std::string text(kPipeline);  // without noise, for straight lines
  text.erase(text.find("[plant]"), text.find("[model]") - text.find("[plant]"));
  return write("p.ini", {text.c_str(), "[gateway]\ntimes = exact\nsmoothing_rad = 0\n", kBusyHost});
}

/// The text of a summary from `key` to the next comma.
std::string number_of(const char* summary, std::string_view key) {
  const std::string_view text = file_of(summary);
  const std::size_t begin = text.find(key);
  assert_true(begin != std::string_view::npos);
  return std::string(text.substr(begin, text.find(',', begin) - begin));
}

// Proves CSV-5.

void a_long_file_is_accepted_whole_and_run_to_its_end(void**) {
  const Line pipeline = quiet_pipeline(), trajectory = write_long("long.csv", 1e-4);
  assert_int_equal(tactus_run({"check", pipeline.c_str(), "--trajectory", trajectory.c_str()}), 0);
  assert_true(has(output(), "long.csv: accepted, 40000 waypoints, 4.0319 s\n"));
  const Line out = in_folder("a");
  assert_int_equal(tactus_run({"run", pipeline.c_str(), "--trajectory", trajectory.c_str(),
                               "--no-figure", "--out", out.c_str()}),
                   0);
  assert_true(has(file_of("a/summary.json"), "\"cycles\": 6032,"));  // and 2 s to settle
  assert_true(has(file_of("a/summary.json"), "\"starved\": 0,"));
  assert_true(has(file_of("a/summary.json"), "\"heap_allocations_in_cycle\": 0,"));
}

void a_pipe_is_run_as_its_file_is(void**) {
  quiet_pipeline();
  write_long("long.csv", 1e-4);
  assert_succeeds("$P run $S/p.ini --trajectory $S/long.csv --no-figure --out $S/a");
  assert_succeeds(
      "cat $S/long.csv | $P run $S/p.ini --trajectory /dev/stdin --no-figure --out $S/b");
  // the end of a pipe's run is later by the time in which the goal is found reached
  assert_succeeds(
      "n=$(wc -l <$S/a/log.csv); test $n -gt 600; head -n $n $S/b/log.csv | "
      "cmp - $S/a/log.csv");
  assert_true(number_of("a/summary.json", "\"config_hash\"") ==
              number_of("b/summary.json", "\"config_hash\""));
  assert_succeeds("cat $S/long.csv | $P check $S/p.ini --trajectory /dev/stdin");
  assert_true(has(output(), "/dev/stdin: accepted, 40000 waypoints, 4.0319 s\n"));
}

// Proves CSV-6.

void a_long_file_is_refused_with_its_line_before_anything_moves(void**) {
  const Line pipeline = quiet_pipeline(), trajectory = write_long("wild.csv", 1e-4, 39'000);
  const Line expected = Line(trajectory)
                        << ":39002: refused: waypoint 39001 (t = 3.932 s), joint "
                           "1 (fer_joint1): position 9 rad exceeds 2.8973 rad (34); ";
  const Line out = in_folder("refused");
  assert_int_equal(tactus_run({"check", pipeline.c_str(), "--trajectory", trajectory.c_str()}), 2);
  assert_true(has(errors(), std::string_view(expected)));
  assert_int_equal(tactus_run({"run", pipeline.c_str(), "--trajectory", trajectory.c_str(),
                               "--no-figure", "--out", out.c_str()}),
                   2);
  assert_true(has(errors(), std::string_view(expected)));
  assert_false(exists("refused"));
}

void a_pipe_that_is_refused_on_the_way_leaves_the_arm_at_rest_on_the_path(void**) {
  quiet_pipeline();
  write_long("wild.csv", 1e-4, 39'000);
  assert_int_equal(
      shell("cat $S/wild.csv | $P run $S/p.ini --trajectory /dev/stdin --no-figure --out $S/w"), 1);
  assert_true(has(errors(), "/dev/stdin:39002: refused: waypoint 39001 (t = 3.932 s), joint 1 "));
  assert_true(has(file_of("w/summary.json"),
                  "\"result\": {\"code\": 34, \"name\": \"refused\", "
                  "\"why\": \"line 39002: waypoint 39001 (t = 3.932 s), joint 1 "));
  // in the last hundredth of a second, after a motion of up to 80 mrad/s
  assert_succeeds(
      "tail -n 2 $S/w/log.csv | cut -d, -f 2 | tr '\\n' ' ' | "
      "awk '{d = $1 - $2; exit !(d * d < 4e-8 && $1 > 1e-3)}'");
  assert_int_equal(shell("cat $S/wild.csv | $P check $S/p.ini --trajectory /dev/stdin"), 2);
  assert_true(has(errors(), "/dev/stdin:39002: refused: waypoint 39001 (t = 3.932 s), joint 1 "));
}

// Proves RG-17.

/// Many waypoints are judged after the arm has been taken over, for more than the first cycle.
void a_start_time_that_has_passed_when_the_file_is_ready_is_refused(void**) {
  const Line pipeline = write("late.ini", {kPipeline, "[gateway]\nstart_s = 0.001\n", kBusyHost});
  const Line trajectory = write_long("long.csv", 1e-4), out = in_folder("late");
  assert_int_equal(tactus_run({"run", pipeline.c_str(), "--trajectory", trajectory.c_str(),
                               "--realtime", "--no-figure", "--out", out.c_str()}),
                   1);
  assert_true(has(errors(), "long.csv: refused: [gateway] start_s: time 0.001 s is earlier than "));
  assert_true(has(errors(), " s (35); it had passed when the trajectory was ready: give a later"));
  assert_true(
      has(file_of("late/summary.json"),
          "\"result\": {\"code\": 35, \"name\": \"refused\", \"why\": \"[gateway] start_s: "));
}

// Proves RUN-1.

void an_interrupt_ends_a_run_that_waits_for_a_pipe(void**) {
  quiet_pipeline();
  write_long("long.csv", 1e-4);
  assert_int_equal(
      shell(
          "mkfifo $S/fifo && exec 3<>$S/fifo && { head -n 35000 $S/long.csv >&3 & } && "
          "{ $P run $S/p.ini --trajectory $S/fifo --no-figure --out $S/i 3>&- & } && reader=$! && "
          "until [ -s $S/i/log.csv ]; do sleep 0.1; done; sleep 1; kill -INT $reader; "
          "wait $reader"),
      1);
  assert_true(has(file_of("i/summary.json"), "{\"code\": 1, \"name\": \"interrupted\"}"));
}

// Proves CSV-7.

/// The window holds 2.05 s of this file.
/// The pipe pauses once the arm is on its way, for longer than the first waypoints last.
void in_real_time_the_arm_waits_on_its_path_for_a_slow_pipe_and_goes_on(void**) {
  quiet_pipeline();
  write_long("long.csv", 6.25e-5);
  assert_succeeds(
      "{ head -n 33000 $S/long.csv; until grep -q ,0[.]09 $S/slow/log.csv; do sleep 0.1; done; "
      "sleep 4; tail -n +33001 $S/long.csv; } | "
      "$P run $S/p.ini --trajectory /dev/stdin --realtime --no-figure --out $S/slow");
  assert_true(has(output(), "waits on the path for /dev/stdin, which came too slowly: "));
  assert_true(
      has(file_of("slow/summary.json"), "\"result\": {\"code\": 0, \"name\": \"succeeded\"}"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_long_file_is_accepted_whole_and_run_to_its_end),
      cmocka_unit_test(a_pipe_is_run_as_its_file_is),
      cmocka_unit_test(a_long_file_is_refused_with_its_line_before_anything_moves),
      cmocka_unit_test(a_pipe_that_is_refused_on_the_way_leaves_the_arm_at_rest_on_the_path),
      cmocka_unit_test(a_start_time_that_has_passed_when_the_file_is_ready_is_refused),
      cmocka_unit_test(an_interrupt_ends_a_run_that_waits_for_a_pipe),
      cmocka_unit_test(in_real_time_the_arm_waits_on_its_path_for_a_slow_pipe_and_goes_on),
  };
  return run_program_tests(argv[0], tests);
}
