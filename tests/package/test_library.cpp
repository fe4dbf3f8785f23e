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
      "make=\"env -u MAKEFLAGS make -s install-kernel\"; $make BOARD=fer_sim PREFIX=$PREFIX && "
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
      cmocka_unit_test(cmake_names_the_robot_that_is_not_installed),
  };
  return run_program_tests(argv[0], tests);
}
