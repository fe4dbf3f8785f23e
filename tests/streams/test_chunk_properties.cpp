// Properties that chunks and velocities keep, whatever a policy sends and the network does with it,
// and with stops, points and restarts at any time: in both spaces, at 1, 2 and 8 ms, for one robot
// per build.
//
// TACTUS_TRIALS is the number of runs of all tests together. A failure prints the seed of its run:
// TACTUS_SEED=<seed> TACTUS_TRIALS=1 repeats it.
#include <cstdlib>

#include "tests/streams/chunk_run.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

constexpr int kTests = 2;
int runs() {
  return trials(tries(240, 20)) / kTests + 1;
}

template <class Space>
void check() {
  const char* wanted = std::getenv("TACTUS_SEED");
  Dice seeds{20261123};
  ReportCounts all;
  int failed = 0;
  static std::aligned_storage_t<sizeof(ChunkRun<Space>), alignof(ChunkRun<Space>)> place, other;
  for (int i = 0; i < runs(); ++i) {
    const std::uint64_t seed =
        wanted != nullptr ? std::strtoull(wanted, nullptr, 10) : seeds.bits();
    auto* const run = new (&place) ChunkRun<Space>(seed);
    if (run->pass() != nullptr && ++failed <= 5) run->print();
    all.sent += run->told().sent;
    all.executed += run->told().executed;
    all.superseded += run->told().superseded;
    all.refused += run->told().refused;
    all.starved += run->told().starved;
    if (i % 16 != 0) continue;
    auto* const again = new (&other) ChunkRun<Space>(seed);
    static_cast<void>(again->pass());
    assert_true(run->sum() == again->sum());
  }
  print_message("%d messages: %d executed, %d superseded, %d refused; %d starved; %d runs failed\n",
                all.sent, all.executed, all.superseded, all.refused, all.starved, failed);
  assert_int_equal(failed, 0);
  if (all.sent < 1000) return;
  assert_true(all.executed > all.sent / 2 && all.superseded > 0 && all.starved > 0);
}

// Proves RG-26, RG-27, RG-28, RG-30.

void joints_keep_every_limit_whatever_chunks_come(void**) {
  check<JointSpace>();
}
void a_tip_keeps_every_limit_whatever_chunks_come(void**) {
  check<TaskSpace>();
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(joints_keep_every_limit_whatever_chunks_come),
      cmocka_unit_test(a_tip_keeps_every_limit_whatever_chunks_come),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
