// Tests the times at which the emulated controller begins its cycles on a host that is sometimes
// late.
#include "sim_plant/ur/server/cycle_grid.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus::ur;

constexpr std::int64_t kPeriod_ns = 8'000'000, kBegin_ns = 5'000'000'000;

/// A host that begins a cycle as soon as it may, and stalls for `stall_ns` before cycle `at`.
struct Host {
  CycleGrid grid{kPeriod_ns, kBegin_ns};
  std::int64_t now_ns = kBegin_ns, shortest_ns = kPeriod_ns;
  std::int64_t cycles = 0;

  void run(int count, int at, std::int64_t stall_ns) {
    for (int k = 0; k < count; ++k) {
      const std::int64_t before_ns = now_ns;
      if (k == at) now_ns += stall_ns;
      const std::int64_t left_ns = grid.left_ns(now_ns);
      if (left_ns > 0) now_ns += left_ns;
      grid.begin(now_ns);
      ++cycles;
      if (k > 0) shortest_ns = std::min(shortest_ns, now_ns - before_ns);
    }
  }
};

// Proves URP-41.

void a_host_in_time_keeps_the_grid(void**) {
  Host host;
  host.run(1000, -1, 0);
  assert_int_equal(host.now_ns, kBegin_ns + 1000 * kPeriod_ns);
  assert_int_equal(host.shortest_ns, kPeriod_ns);
}

void what_was_late_is_caught_up(void**) {
  for (const std::int64_t stall_ms : {1, 9, 40, 100, 900}) {
    Host host;
    host.run(1000, 100, stall_ms * 1'000'000);
    assert_int_equal(host.now_ns, kBegin_ns + 1000 * kPeriod_ns);
  }
}

void clients_have_time_to_answer_between_two_cycles(void**) {
  Host host;
  host.run(1000, 100, 100'000'000);
  assert_int_equal(host.shortest_ns, kPeriod_ns / 2);
}

void after_more_than_a_second_the_time_is_let_go(void**) {
  Host host;
  host.run(1000, 100, 3'000'000'000);
  // By the host's own clock the 101st cycle begins 3 s late, and the grid moves with it.
  assert_int_equal(host.now_ns, kBegin_ns + 999 * kPeriod_ns + 3'000'000'000);
  assert_int_equal(host.shortest_ns, kPeriod_ns);
}

void a_grid_that_begins_anew_owes_nothing(void**) {
  CycleGrid grid(kPeriod_ns, kBegin_ns);
  grid.begin_anew(kBegin_ns + 500'000'000);
  assert_int_equal(grid.left_ns(kBegin_ns + 500'000'000), kPeriod_ns);
  grid.begin_anew(kBegin_ns + 500'000'001);
  assert_int_equal(grid.left_ns(kBegin_ns + 500'000'001), kPeriod_ns);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_host_in_time_keeps_the_grid),
      cmocka_unit_test(what_was_late_is_caught_up),
      cmocka_unit_test(clients_have_time_to_answer_between_two_cycles),
      cmocka_unit_test(after_more_than_a_second_the_time_is_let_go),
      cmocka_unit_test(a_grid_that_begins_anew_owes_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
