// Tests that the cycle does not notice what clients do: its instructions, counted by callgrind,
// while eight of them flood the server. The program counts itself: called with the name of a flood,
// it runs the cycles under valgrind; the tests start it so.
#include <valgrind/callgrind.h>

#include <optional>

#include "tests/gateway/server/cycle_bench.hpp"
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr int kCycles = 60;
constexpr int kFloods = kMostClients;

// --- what is counted ---

struct Hostile {
  CycleBench bench;
  std::array<TestClient, kFloods> clients;
  Random random{81};
};

/// Sends every kind of message but those that everybody may send to the cycle, and sometimes bytes
/// that are no message.
void flood_with_everything(Hostile& hostile, TestClient& from) {
  const JointVector q = ServerBench::home().q;
  from.point(q);
  from.send(ask::kVelocity, RawMessage().number(3, 100).reals(4, q.data(), kDof));
  for (const std::uint32_t kind : {ask::kHello, ask::kChunk, ask::kBegin, ask::kPart, ask::kEnd,
                                   ask::kResume, ask::kRearm, ask::kParameters, ask::kPing})
    from.send(kind);
  from.send(ask::kSubscribe, RawMessage().number(1, 1).number(2, 1).number(3, 1));
  if (hostile.random.below(40) > 0) return;
  RawMessage junk;
  for (int i = 0; i < 500; ++i) junk.byte(static_cast<std::uint8_t>(hostile.random.below(256)));
  from.push(junk.bytes.data(), junk.size);
}

/// Sends more references and controls than a cycle takes, the same in each so that it does not
/// matter which of them wait.
void flood_as_owner(TestClient& from, int cycle) {
  JointVector q = ServerBench::home().q;
  q[0] += 1e-3 * cycle;
  for (int i = 0; i < 20; ++i) {
    from.point(q);
    from.send(ask::kOverride, RawMessage().real(1, 0.5));
  }
}

/// The server has turns until it has taken everything that was sent.
void hear(Hostile& hostile) {
  for (int turn = 0; turn < 3; ++turn) {
    hostile.bench.server->work(hostile.bench.now_ns);
    for (TestClient& client : hostile.clients) client.read();
  }
}

/// Runs the cycles; callgrind dumps the count of each. `what`: "calm", nobody sends anything;
/// "flood", eight clients without a lease do; "owner", one who has it; "mixed", him and the others.
int count(const char* what) {
  const bool owns = *what == 'o' || *what == 'm', floods = *what == 'f' || *what == 'm';
  static Hostile hostile;
  CycleBench& bench = hostile.bench;
  bench.start();
  for (TestClient& client : hostile.clients) bench.welcome(client, "hostile");
  if (owns) hostile.clients[0].lease();
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    for (TestClient& client : hostile.clients) {
      if (client.finished()) {
        client.close();
        bench.welcome(client, "again");
      }
      const bool owner = owns && &client == hostile.clients.data();
      if (owner) flood_as_owner(client, cycle);
      if (floods && !owner) flood_with_everything(hostile, client);
    }
    hear(hostile);
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_ZERO_STATS;
    bench.cycle();
    CALLGRIND_TOGGLE_COLLECT;
    CALLGRIND_DUMP_STATS_AT("cycle");
    hear(hostile);
  }
  return 0;
}

// --- the tests ---

const char* self = nullptr;  ///< the path that this program is called by

struct Counts {
  std::array<long, kCycles> instructions{};
  long most = 0;
};

/// Counts every cycle in a process of its own.
Counts counts_of(const char* what) {
  Line command("mkdir -p $S/");
  command << what
          << " && valgrind -q --tool=callgrind --collect-atstart=no --callgrind-out-file=$S/"
          << what << "/dump " << self << " " << what << " && cd $S/" << what
          << " && sed -n 's/^totals: //p' $(seq -f dump.%g " << kCycles << ")";
  const int code = shell(command.c_str());
  if (code != 0) print_error("%.*s\n", static_cast<int>(errors().size()), errors().data());
  assert_int_equal(code, 0);
  Counts counts;
  const char* at = output().data();
  for (long& instructions : counts.instructions) {
    char* end = nullptr;
    instructions = std::strtol(at, &end, 10);
    assert_true(end != at && instructions > 1000);
    counts.most = std::max(counts.most, instructions);
    at = end;
  }
  return counts;
}

/// Counted once, for both tests.
const Counts& calm_counts() {
  static std::optional<Counts> calm;
  if (!calm) calm = counts_of("calm");
  return *calm;
}

void need_valgrind() {
#ifdef TACTUS_SANITIZED
  _skip(__FILE__, __LINE__);
#endif
  assert_succeeds("command -v valgrind || { echo as root: scripts/setup test >&2; false; }");
}

// Proves GW-12.

void eight_hostile_clients_cost_the_cycle_no_instruction(void**) {
  need_valgrind();
  const Counts &calm = calm_counts(), flood = counts_of("flood");
  for (std::size_t i = 0; i < kCycles; ++i)
    assert_int_equal(flood.instructions[i], calm.instructions[i]);
}

void the_mail_of_an_owner_costs_a_cycle_what_it_costs_without_seven_hostile_clients(void**) {
  need_valgrind();
  const Counts &calm = calm_counts(), owner = counts_of("owner"), mixed = counts_of("mixed");
  assert_true(owner.most > calm.most);
  for (std::size_t i = 0; i < kCycles; ++i)
    assert_int_equal(mixed.instructions[i], owner.instructions[i]);
  print_message("instructions of a cycle: %ld without mailboxes, %ld with as much as it takes\n",
                calm.most, owner.most);
}

}  // namespace
}  // namespace tactus

int main(int argc, char** argv) {
  using namespace tactus;
  if (argc == 2) return count(argv[1]);
  self = argv[0];
  const CMUnitTest tests[] = {
      cmocka_unit_test(eight_hostile_clients_cost_the_cycle_no_instruction),
      cmocka_unit_test(
          the_mail_of_an_owner_costs_a_cycle_what_it_costs_without_seven_hostile_clients),
  };
  return run_program_tests(argv[0], tests);
}
