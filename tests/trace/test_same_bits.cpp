// The same bits on the Cortex-M7 and on this computer, for one run; scripts/check compares all
// runs, and aarch64 too.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves EXE-12.

void a_run_gives_the_same_bytes_on_another_machine(void**) {
  const int code = shell("scripts/same_bits --machine Cortex-M7 fer_jrg_pdgc:fer_five_waypoints");
  assert_int_equal(code, 0);
  assert_true(has(output(), "Cortex-M7"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {cmocka_unit_test(a_run_gives_the_same_bytes_on_another_machine)};
  return run_program_tests(argv[0], tests);
}
