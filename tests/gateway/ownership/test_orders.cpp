// Tests every order in which three clients, faults, cycles and the clock can act on the server,
// with links that hold messages up, against the rules of docs/gateway.md.
#include "tests/gateway/ownership/order_bench.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

// Proves GW-20.

enum class What : std::uint8_t {
  kSend,
  kArrive,
  kSay,
  kLeave,
  kJoin,
  kCycle,
  kSettle,
  kFault,
  kSilence
};
struct Act {
  What what = What::kCycle;
  int client = 0;
  Asked asked;
};
/// Acts that follow each other; others may come between them.
using Thread = std::vector<Act>;

constexpr int kA = 0, kB = 1, kC = 2;
constexpr Asked kStop = {ask::kStop}, kPause = {ask::kPause}, kCancel = {ask::kCancel},
                kRearm = {ask::kRearm}, kResume = {ask::kResume}, kRaise = {ask::kOverride, 0.9},
                kLower = {ask::kOverride, 0.2}, kBetween = {ask::kOverride, 0.5},
                kLease = {ask::kLease, 5.0}, kTakeOver = {ask::kLease, 9.0},
                kGiveBack = {ask::kLease, -1.0};

/// What A, who owns the motion, has done before.
const std::vector<Asked> kBefore = {{}, kPause, kLower, kStop};
/// What A asks over a link that holds it up.
const std::vector<std::vector<Asked>> kLate = {
    {kRearm, kRearm},  {kResume, kRaise}, {kRearm, kBetween}, {kStop, kRearm},
    {kLease, kResume}, {kLease, kRearm},  {kPause, kResume},  {kGiveBack, kRaise}};
const std::vector<Thread> kOfB = {{{What::kSay, kB, kStop}},
                                  {{What::kSay, kB, kTakeOver}},
                                  {{What::kSay, kB, kStop}, {What::kSay, kB, kTakeOver}}};
const std::vector<Thread> kOfC = {{{What::kSay, kC, kPause}},
                                  {{What::kSay, kC, kLower}},
                                  {{What::kSay, kC, kCancel}},
                                  {{What::kLeave, kA, {}}, {What::kJoin, kA, {}}}};
const std::vector<Thread> kOfRobot = {
    {{What::kFault, 0, {}}}, {{What::kSilence, 0, {}}}, {{What::kCycle, 0, {}}}};

/// The acts since the beginning of the order that is tried; a failure leaves it for print_order().
std::vector<Act> order;

int print_order(void**) {
  constexpr const char* kNames[] = {"send",  "arrive", "say",   "leave",  "join",
                                    "cycle", "settle", "fault", "silence"};
  for (const Act& act : order)
    print_message("%s %c %u %g, ", kNames[static_cast<int>(act.what)], 'A' + act.client,
                  act.asked.kind, act.asked.rate);
  if (!order.empty()) print_message("\n");
  return 0;
}

struct Explorer {
  OrderBench& bench;
  Random& random;
  std::vector<Thread> threads;
  std::vector<std::vector<std::byte>> states{};
  std::vector<std::size_t> at{};
  long orders = 0;

  static constexpr std::size_t kBeginning = 3;  // acts
  static constexpr int kFollowed = 16;          // one of so many beginnings is followed to its ends

  bool possible(const Act& act) const {
    return act.what != What::kArrive || bench.holds_up(act.client);
  }
  void perform(const Act& act) const {
    switch (act.what) {
      case What::kSend: return bench.send(act.client, act.asked);
      case What::kArrive: return bench.arrive(act.client);
      case What::kSay: return bench.say(act.client, act.asked);
      case What::kLeave: return bench.leave(act.client);
      case What::kJoin: return bench.join(act.client);
      case What::kCycle: return bench.cycle();
      case What::kSettle: return bench.settle();
      case What::kFault: return bench.cycle(true);
      case What::kSilence: return bench.fall_silent();
    }
  }
  void explore() {
    at.assign(threads.size(), 0);
    states.resize(20);
    follow(0);
  }
  void follow(std::size_t depth) {
    if (depth == kBeginning && random.below(kFollowed) != 0) return;
    bool ends = true;
    bench.save(states[depth]);
    for (std::size_t i = 0; i < threads.size(); ++i) {
      if (at[i] == threads[i].size()) continue;
      if (!ends) bench.restore(states[depth]);
      if (!possible(threads[i][at[i]])) continue;
      ends = false;
      const Act act = threads[i][at[i]++];
      order.push_back(act);
      perform(act);
      follow(depth + 1);
      order.pop_back();
      --at[i];
    }
    if (!ends) return;
    ++orders;
    bench.settle();
  }
};

/// The states of the bench behind what A has done before.
std::vector<std::vector<std::byte>> beginnings(OrderBench& bench) {
  bench.start();
  std::vector<std::vector<std::byte>> saved(1 + kBefore.size());
  bench.save(saved.back());
  for (std::size_t i = 0; i < kBefore.size(); ++i) {
    bench.restore(saved.back());
    if (kBefore[i].kind != 0) bench.say(kA, kBefore[i]);
    bench.settle();
    bench.save(saved[i]);
  }
  return saved;
}

template <class Choices>
const auto& one_of(const Choices& choices, Random& random) {
  return choices[static_cast<std::size_t>(random.below(static_cast<int>(choices.size())))];
}

void nothing_moves_the_arm_that_was_asked_before_it_was_stopped_in_any_order(void**) {
  static OrderBench bench;
  const auto begun = beginnings(bench);
  const long wanted = trials(tries(100'000, 2'000));
  Random random{61};
  long tried = 0;
  while (tried < wanted) {
    const auto before = static_cast<std::size_t>(random.below(static_cast<int>(kBefore.size())));
    bench.restore(begun[before]);
    order = {{What::kSay, kA, kBefore[before]}};
    Thread sends, arrives;
    for (const Asked& asked : one_of(kLate, random)) {
      sends.push_back({What::kSend, kA, asked});
      arrives.push_back({What::kArrive, kA, {}});
    }
    Explorer explorer{bench,
                      random,
                      {sends,
                       arrives,
                       one_of(kOfB, random),
                       one_of(kOfC, random),
                       one_of(kOfRobot, random),
                       {{What::kCycle, 0, {}}},
                       {{What::kSettle, 0, {}}}}};
    explorer.explore();
    tried += explorer.orders;
  }
  order.clear();
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test_teardown(
          nothing_moves_the_arm_that_was_asked_before_it_was_stopped_in_any_order, print_order),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
