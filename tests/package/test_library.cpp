// Tests the kernel as an installed library: programs of others that see nothing but the prefix.
#include "tests/program/pages/page_script.hpp"

namespace tactus {
namespace {

constexpr PageScript kCommands{"$R/tests/program/pages/try_tutorial.py "};

/// Installs the kernel of the FER for this computer and for a Cortex-M7.
int install(void**) {
  setenv("PREFIX", in_folder("host").c_str(), 1);
  setenv("PREFIX_M7", in_folder("m7").c_str(), 1);
  return shell(
      "make=\"make -s install-kernel\"; $make BOARD=fer_sim PREFIX=$PREFIX && "
      "$make BOARD=fer_m7 ARCH=m7 PREFIX=$PREFIX_M7 || { cat $S/err $S/out; exit 1; }");
}

// Proves KER-7.

void the_page_prints_what_it_says(void**) {
  kCommands.assert_true_of("docs/library.md");
}

/// No caller has the options of the project: his warnings are on, assertions too.
void every_header_compiles_by_itself(void**) {
  assert_succeeds(
      "cd $S; for layer in core model control reference pipeline; do printf '#include "
      "<tactus/%s.hpp>\\n' fer $layer >a.cpp; g++ -std=c++17 -Wall -Wextra -Werror -fsyntax-only "
      "$(PKG_CONFIG_PATH=$PREFIX/lib/pkgconfig pkg-config --cflags tactus-kernel-fer) a.cpp || "
      "exit; done");
}

void without_the_robot_the_header_says_which_one_is_missing(void**) {
  assert_true(shell("echo '#include <tactus/control.hpp>' >$S/a.cpp; g++ -std=c++17 -c $S/a.cpp -o "
                    "$S/a.o -I$PREFIX/include/tactus") != 0);
  assert_true(has(errors(), "include the header of the robot first, for example <tactus/fer.hpp>"));
}

void only_what_the_layers_include_is_installed(void**) {
  assert_succeeds(
      "cd $PREFIX/include/tactus; test -e kernel/cycle/executive.hpp && "
      "! ls kernel/core/precompiled.hpp kernel/robots/ur10.hpp kernel/load/number.hpp");
}

void an_rtos_needs_to_give_nothing_but_its_own_functions(void**) {
  write("rtos_stub.cpp",
        {"extern \"C\" {\nunsigned long xTaskGetTickCount() { return 0; }\n"
         "void vTaskDelay(unsigned long) {}\n"
         "bool wire_exchange(const double*, bool, double*, double*) { return true; }\n"
         "void control_task(void*);\nvoid _start() { control_task(nullptr); }\n}\n"});
  assert_succeeds(
      "export PKG_CONFIG_PATH=$PREFIX_M7/lib/pkgconfig; arm-none-eabi-g++ -std=c++17 -O2 "
      "-fno-exceptions -fno-rtti -nostdlib examples/rtos.cpp $S/rtos_stub.cpp "
      "$(pkg-config --cflags --libs tactus-kernel-fer) -lc -lm -lgcc -o $S/rtos.elf && "
      "! arm-none-eabi-nm $S/rtos.elf | grep -E ' (malloc|_sbrk|__cxa_throw)$'");
}

/// The same source on this computer, with a wire whose robot is where it was commanded to be, and
/// the other task in the place where the cycle's task sleeps.
void the_task_of_an_rtos_moves_the_arm(void**) {
  write("rtos_host.cpp",
        {"#include <tactus/fer.hpp>\n#include <tactus/reference.hpp>\n#include <cstdio>\n"
         "#include <cstdlib>\nusing namespace tactus;\n"
         "extern ReferenceClient<JointSpace> client;\n"
         "static std::uint32_t tick;\nstatic double now[7] = {0, -0.8, 0, -2.4, 0, 1.6, 0.8};\n"
         "extern \"C\" {\nvoid control_task(void*);\n"
         "std::uint32_t xTaskGetTickCount() { return tick; }\n"
         "void vTaskDelay(std::uint32_t ticks) {\n  tick += ticks;\n  std::uint32_t id;\n"
         "  JointSpace::Point goal;\n  goal.q << 0.3, -0.8, 0, -2.4, 0, 1.6, 0.8;\n"
         "  if (tick == 1000 && !client.send(goal, id).ok()) std::exit(2);\n"
         "  if (tick == 3000) std::exit(std::printf(\"%.6f\\n\", now[0]) > 0 ? 0 : 1);\n}\n"
         "bool wire_exchange(const double* command, bool, double* q, double* dq) {\n"
         "  for (int i = 0; i < 7; ++i) {\n    if (command != nullptr) now[i] = command[i];\n"
         "    q[i] = now[i];\n    dq[i] = 0;\n  }\n  return true;\n}\n}\n"
         "int main() { control_task(nullptr); return 3; }\n"});
  assert_succeeds(
      "export PKG_CONFIG_PATH=$PREFIX/lib/pkgconfig; g++ -std=c++17 -O1 -Wall -Wextra -Werror "
      "examples/rtos.cpp $S/rtos_host.cpp $(pkg-config --cflags --libs tactus-kernel-fer) "
      "-o $S/rtos && $S/rtos");
  assert_true(output() == "0.300000\n");
}

void cmake_names_the_robot_that_is_not_installed(void**) {
  write("CMakeLists.txt", {"cmake_minimum_required(VERSION 3.18)\nproject(own CXX)\n"
                           "find_package(Tactus REQUIRED COMPONENTS gen3)\n"});
  assert_true(shell("cmake -S $S -B $S/own -DCMAKE_PREFIX_PATH=$PREFIX") != 0);
  assert_true(has(errors(), "the kernel of robot gen3 is not installed"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_setup(the_page_prints_what_it_says, install),
      cmocka_unit_test(every_header_compiles_by_itself),
      cmocka_unit_test(without_the_robot_the_header_says_which_one_is_missing),
      cmocka_unit_test(only_what_the_layers_include_is_installed),
      cmocka_unit_test(an_rtos_needs_to_give_nothing_but_its_own_functions),
      cmocka_unit_test(the_task_of_an_rtos_moves_the_arm),
      cmocka_unit_test(cmake_names_the_robot_that_is_not_installed),
  };
  return run_program_tests(argv[0], tests);
}
