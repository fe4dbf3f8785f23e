// Tests that two robots fit into one program, and that objects of different robots or switches do
// not link. The model of an arm and its caller are compiled apart, for several builds.
#include <cstdlib>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// Compiles model and caller for two robots, and the caller with another switch.
int plant_sources(void**) {
  write("model.cpp", {"#include \"kernel/model/robot_model.cpp\"\n"});
  write("tip.cpp", {"#include \"kernel/model/robot_model.hpp\"\n"
                    "extern \"C\" double TIP() {\n"
                    "  tactus::RobotModel model;\n"
                    "  model.start();\n"
                    "  return model.x.value.p[AXIS];\n"
                    "}\n"});
  write("main.cpp", {"#include <cstdio>\n"
                     "extern \"C\" double fer_z();\n"
                     "extern \"C\" double ur10_x();\n"
                     "int main() { std::printf(\"%.4f %.4f\\n\", fer_z(), ur10_x()); }\n"});
  setenv("G",
         "g++ -std=c++17 -I. -isystem /usr/include/eigen3 -DEIGEN_DONT_VECTORIZE "
         "-include kernel/core/build.hpp",
         1);
  setenv("FER",
         "-DTACTUS_ROBOT=Fer -DTACTUS_ROBOT_TABLES=\"kernel/robots/fer_capsules.hpp\" "
         "-DTIP=fer_z -DAXIS=2",
         1);
  setenv("UR10",
         "-DTACTUS_ROBOT=Ur10 -DTACTUS_ROBOT_TABLES=\"kernel/robots/ur10_capsules.hpp\" "
         "-DTIP=ur10_x -DAXIS=0",
         1);
  return shell(
      "for robot in fer ur10; do case $robot in fer) for=$FER;; *) for=$UR10;; esac; "
      "for part in model tip; do $G $for -c $S/$part.cpp -o $S/$part.$robot.o || exit 1; done; "
      "done; $G $FER -DTACTUS_TUNING=0 -c $S/tip.cpp -o $S/tip.other.o && "
      "g++ -c $S/main.cpp -o $S/main.o");
}

// Proves KER-6.

void two_robots_fit_into_one_program(void**) {
  assert_succeeds("g++ -o $S/both $S/main.o $S/*.fer.o $S/*.ur10.o && $S/both");
  // With all joints at zero: the sums of the published lengths, upwards and along the arm.
  assert_true(output() == "0.9260 -1.1843\n");
}

void objects_of_different_robots_do_not_link(void**) {
  assert_true(shell("g++ -o $S/mixed $S/main.o $S/tip.fer.o $S/*.ur10.o") != 0);
  assert_true(has(errors(), "tactus_Fer_128_1_1::RobotModel::start()"));
}

void objects_with_different_switches_do_not_link(void**) {
  assert_true(shell("g++ -o $S/mixed $S/main.o $S/tip.other.o $S/model.fer.o $S/*.ur10.o") != 0);
  assert_true(has(errors(), "tactus_Fer_128_0_1::RobotModel::start()"));
}

void a_vectorised_source_does_not_compile(void**) {
  assert_true(shell("$G -UEIGEN_DONT_VECTORIZE $FER -c $S/tip.cpp -o $S/x.o") != 0);
  assert_true(has(errors(), "compile with -DEIGEN_DONT_VECTORIZE"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(two_robots_fit_into_one_program, plant_sources),
      cmocka_unit_test(objects_of_different_robots_do_not_link),
      cmocka_unit_test(objects_with_different_switches_do_not_link),
      cmocka_unit_test(a_vectorised_source_does_not_compile),
  };
  return run_program_tests(argv[0], tests);
}
