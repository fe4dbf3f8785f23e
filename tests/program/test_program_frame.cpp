// Tests the program with references in a frame of the pipeline: the motion, and the files written.
#include <cmath>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves RG-19.

/// The tip moves by 0.1 m along the x axis of a frame rotated by a right angle, that is, along y.
void a_trajectory_may_be_given_in_a_frame_of_the_pipeline(void**) {
  constexpr const char* kTask =
      "[wall]\ntype = frame\nposition = 0.5 0 0.5\nrotation = 0 0 1.57079632679\n"
      "[trg]\ntype = task_reference_generator\nx = model.x\n"
      "goal_position_tolerance = 0\ngoal_angle_tolerance = 0\n"
      "path_position_tolerance = 0\npath_angle_tolerance = 0\n"
      "[gateway]\nstart_s = 1\nmotion_frame = ";
  constexpr const char* kPath =
      "time_s,x_m,y_m,z_m,qw,qx,qy,qz\n6,0,0,0,0,1,0,0\n9,0.1,0,0,0,1,0,0\n";
  const Line path = write("t.csv", {kPath});
  const auto run_in = [&](const char* frame) {
    const Line pipeline = write("f.ini", {kPipeline, "signals = trg.x_d\n", kTask, frame, "\n"});
    return tactus_run({"run", pipeline.c_str(), "--trajectory", path.c_str(), "--no-figure",
                       "--out", in_folder("f").c_str()});
  };
  assert_int_equal(run_in("wall.x"), 0);
  const std::string_view text = file_of("f/log.csv");
  const std::string_view last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  double time_s = 0.0, x = 0.0, y = 0.0, z = 0.0;
  assert_int_equal(std::sscanf(Line(last).c_str(), "%lf,%lf,%lf,%lf", &time_s, &x, &y, &z), 4);
  ASSERT_NEAR(x, 0.5, 1e-9);
  ASSERT_NEAR(y, 0.1, 1e-9);
  ASSERT_NEAR(z, 0.5, 1e-9);
  ASSERT_NEAR(time_s, 11.99, 1e-9);  // 1 s to wait, 9 s, 2 s to settle
  assert_int_equal(run_in("Wall.x"), 2);
  assert_true(
      has(errors(), "[gateway] motion_frame: 'Wall.x' is not an output of this pipeline\n"));
  assert_int_equal(run_in("model.v"), 2);
  assert_true(has(errors(), "[gateway] motion_frame: 'model.v' is not a pose\n"));
}

// Proves RUN-7.

/// A frame as above; waypoints.csv must be comparable with the signals that follow the waypoints.
void waypoints_given_in_a_frame_are_written_in_the_base_frame(void**) {
  const Line trajectory =
      write("t.csv", {"time_s,x_m,y_m,z_m,qw,qx,qy,qz\n6,0,0,0,0,1,0,0\n9,0.1,0,0,0,1,0,0\n"});
  const Line pipeline = write(
      "w.ini",
      {kWithoutGenerator, "[wall]\ntype = frame\nposition = 0.5 0 0.25\nrotation = 0 0 ",
       "1.57079632679489662\n[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n",
       "[trg]\ntype = task_reference_generator\nx = model.x\n[gateway]\nmotion_frame = wall.x\n",
       "[recorder]\ntracking = trg.x_d model.x\n"});
  assert_int_equal(run_into("w", pipeline.c_str(), "1", trajectory.c_str(), "0.01"), 1);
  const std::string_view text = file_of("w/waypoints.csv");
  const std::string_view last = text.substr(text.rfind('\n', text.size() - 2) + 1);
  std::array<double, 8> n{};
  assert_int_equal(std::sscanf(Line(last).c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &n[0], &n[1],
                               &n[2], &n[3], &n[4], &n[5], &n[6], &n[7]),
                   8);
  // a half turn about x, then a quarter turn about z: (cos 45, 0, 0, sin 45) (0, 1, 0, 0)
  const std::array<double, 8> expected = {9.0, 0.5, 0.1, 0.25, 0.0, std::sqrt(0.5), std::sqrt(0.5),
                                          0.0};
  for (std::size_t i = 0; i < n.size(); ++i) ASSERT_NEAR(n[i], expected[i], 1e-8);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_trajectory_may_be_given_in_a_frame_of_the_pipeline),
      cmocka_unit_test(waypoints_given_in_a_frame_are_written_in_the_base_frame),
  };
  return run_program_tests(argv[0], tests);
}
