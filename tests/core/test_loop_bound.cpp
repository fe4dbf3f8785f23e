// Tests LoopBound: it is empty in a release build; in a test build it aborts a loop that exceeds
// its bound.
#include "kernel/core/loop_bound.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <type_traits>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

/// Exit of a process whose loop ticks `times` times: 0, or the signal that stopped it.
int ticking(int times) {
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);
    close(STDERR_FILENO);
    LoopBound<3> bound;
    for (int i = 0; i < times; ++i) bound.tick();
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
}

// Proves BND-4.

void as_many_runs_as_are_said_are_fine(void**) {
  assert_int_equal(ticking(3), 0);
}

void one_more_stops_a_test_build_and_costs_a_release_nothing(void**) {
#ifndef TACTUS_SANITIZED
  assert_true(std::is_empty_v<LoopBound<3>>);
  assert_int_equal(ticking(4), 0);
#else
  assert_int_equal(ticking(4), SIGABRT);
#endif
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(as_many_runs_as_are_said_are_fine),
      cmocka_unit_test(one_more_stops_a_test_build_and_costs_a_release_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
