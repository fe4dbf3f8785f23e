// All orders in which up to three requests can arrive, within a cycle and across cycles, and some
// of four, from every state: checks the outcome of each request, each store and the reference.

#include "tests/reference/generator/interleaving_rehearsal.hpp"
#include "tests/support/testing.hpp"
#include "tests/support/trials.hpp"

namespace {

using namespace tactus;

void print_case(const Case& c, const char* complaint) {
  print_error("not so: %s\n  %s", complaint, kBeginWords[static_cast<std::size_t>(c.begin)]);
  for (int i = 0; i < c.count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    print_error(", %s in cycle %d", kAskWords[static_cast<std::size_t>(c.asks[at])],
                c.cycles[at] + 1);
  }
  print_error("\n");
}

/// Writes the digits of `code` to the base `base`, least significant first.
template <class Digit>
void write_digits(int code, int base, std::array<Digit, kMostAsked>& digits) {
  for (Digit& digit : digits) {
    digit = static_cast<Digit>(code % base);
    code /= base;
  }
}

int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

bool in_order(const Case& c) {
  for (int i = 1; i < c.count; ++i) {
    if (c.cycles[static_cast<std::size_t>(i)] < c.cycles[static_cast<std::size_t>(i - 1)])
      return false;
  }
  return true;
}

/// The requests that can be made, and the states to begin in.
struct Game {
  std::array<Begin, 7> begins;
  int begin_count;
  std::array<Ask, 8> asks;
};
constexpr int kAsks = 8;
constexpr Game kClosed = {{Begin::kOnline, Begin::kExecuting, Begin::kBraking, Begin::kPausing,
                           Begin::kPaused, Begin::kWaiting, Begin::kRefusing},
                          7,
                          {Ask::kPoint, Ask::kTrajectory, Ask::kLater, Ask::kTooFast, Ask::kCancel,
                           Ask::kHalf, Ask::kPause, Ask::kResume}};
constexpr Game kOpen = {{Begin::kOnline, Begin::kStreaming, Begin::kStarving},
                        3,
                        {Ask::kPoint, Ask::kTrajectory, Ask::kOpen, Ask::kFeed, Ask::kLast,
                         Ask::kCancel, Ask::kPause, Ask::kResume}};

Rehearsal& rehearsal(OnlineMode mode) {
  static Rehearsal rehearsals[] = {Rehearsal(OnlineMode::kForward), Rehearsal(OnlineMode::kLimit)};
  return rehearsals[static_cast<std::size_t>(mode)];
}

bool play(OnlineMode mode, const Game& game, int what, Case& c) {
  write_digits(what, kAsks, c.asks);
  for (Ask& ask : c.asks) ask = game.asks[static_cast<std::size_t>(ask)];
  const char* complaint = rehearsal(mode).play(c);
  if (complaint != nullptr) print_case(c, complaint);
  return complaint == nullptr;
}

/// Plays every case of `count` requests that begins at `begin`. Returns their number, or -1 after
/// the first that breaks the rules.
int play_all(OnlineMode mode, const Game& game, Begin begin, int count) {
  int played = 0;
  Case c = {begin, count, {}, {}};
  for (int when = 0; when < power(kCycles, count); ++when) {
    write_digits(when, kCycles, c.cycles);
    if (!in_order(c)) continue;
    for (int what = 0; what < power(kAsks, count); ++what, ++played) {
      if (!play(mode, game, what, c)) return -1;
    }
  }
  return played;
}

int play_up_to(int most, OnlineMode mode, const Game& game) {
  int played = 0;
  for (int b = 0; b < game.begin_count; ++b) {
    for (int count = 0; count <= most; ++count) {
      const int more = play_all(mode, game, game.begins[static_cast<std::size_t>(b)], count);
      if (more < 0) return -1;
      played += more;
    }
  }
  print_message("  %d interleavings\n", played);
  return played;
}

/// Plays `count` cases of `size` requests at random.
bool play_some(OnlineMode mode, const Game& game, int size, int count) {
  Random random{2117};
  for (int i = 0; i < count; ++i) {
    Case c = {game.begins[static_cast<std::size_t>(random.below(game.begin_count))], size, {}, {}};
    do {
      for (int& cycle : c.cycles) cycle = random.below(kCycles);
    } while (!in_order(c));
    if (!play(mode, game, random.below(power(kAsks, size)), c)) return false;
  }
  return true;
}

constexpr int kMost = tries(3, 2);
constexpr int kCases = 1 + 8 * 3 + 64 * 6 + tries(512 * 10, 0);

// n requests have 8^n kinds times (n+1)(n+2)/2 ways to place them in three cycles.

// Proves RG-1, RG-3, RG-4, RG-5, RG-11.

void every_interleaving_does_what_the_rules_say(void**) {
  assert_int_equal(play_up_to(kMost, OnlineMode::kForward, kClosed), 7 * kCases);
  assert_true(play_some(OnlineMode::kForward, kClosed, 4, trials(1000)));
}

void with_open_trajectories_too(void**) {
  assert_int_equal(play_up_to(kMost, OnlineMode::kForward, kOpen), 3 * kCases);
  assert_true(play_some(OnlineMode::kForward, kOpen, 4, trials(1000)));
}

// Proves RG-5, RG-12.

void with_points_kept_within_limits_no_interleaving_makes_a_step(void**) {
  assert_int_equal(play_up_to(kMost, OnlineMode::kLimit, kClosed), 7 * kCases);
  assert_int_equal(play_up_to(kMost, OnlineMode::kLimit, kOpen), 3 * kCases);
  assert_true(play_some(OnlineMode::kLimit, kClosed, 4, trials(1000)));
  assert_true(play_some(OnlineMode::kLimit, kOpen, 4, trials(1000)));
}

/// Except kLeaving, which needs a path close to a position limit, and those of chunks.
void every_phase_was_seen(void**) {
  for (std::size_t i = 0; i < kPhases; ++i) {
    const MotionPhase phase = static_cast<MotionPhase>(i);
    if (phase == MotionPhase::kLeaving || streams(phase)) continue;
    assert_true(rehearsal(OnlineMode::kForward).seen(phase));
    assert_true(rehearsal(OnlineMode::kLimit).seen(phase));
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_interleaving_does_what_the_rules_say),
      cmocka_unit_test(with_open_trajectories_too),
      cmocka_unit_test(with_points_kept_within_limits_no_interleaving_makes_a_step),
      cmocka_unit_test(every_phase_was_seen),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
