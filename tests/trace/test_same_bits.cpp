// The same bits on the machines that this computer has compilers and emulators for; scripts/check
// compares all runs, this test one.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves EXE-12.

void a_run_gives_the_same_bytes_on_every_machine(void**) {
  const int code = shell("scripts/same_bits gen3_jrg_pdgc");
  if (code == 77) _skip(__FILE__, __LINE__);
  assert_int_equal(code, 0);
  assert_true(has(output(), "aarch64"));
  assert_true(has(output(), "Cortex-M7"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {cmocka_unit_test(a_run_gives_the_same_bytes_on_every_machine)};
  return run_program_tests(argv[0], tests);
}
