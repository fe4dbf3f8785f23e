// All orders in which up to four requests can arrive, within a cycle and across cycles, from every
// state: what becomes of each request, of each store and of the reference.
#include "tests/interleaving_rehearsal.hpp"
#include "tests/testing.hpp"

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

/// The digits of `code` to the base `base`, least significant first.
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

/// Plays every case of `count` requests that begins there; how many there are, or -1 after the
/// first that goes otherwise than the rules say.
int play_all(Rehearsal& rehearsal, Begin begin, int count) {
  int played = 0;
  Case c = {begin, count, {}, {}};
  for (int when = 0; when < power(kCycles, count); ++when) {
    write_digits(when, kCycles, c.cycles);
    if (!in_order(c)) continue;
    for (int what = 0; what < power(kAsks, count); ++what) {
      write_digits(what, kAsks, c.asks);
      const char* complaint = rehearsal.play(c);
      if (complaint != nullptr) return print_case(c, complaint), -1;
      ++played;
    }
  }
  return played;
}

int play_up_to(int most, OnlineMode mode) {
  static Rehearsal rehearsals[] = {Rehearsal(OnlineMode::kForward), Rehearsal(OnlineMode::kLimit)};
  int played = 0;
  for (const Begin begin : kBegins) {
    for (int count = 0; count <= most; ++count) {
      const int more = play_all(rehearsals[static_cast<std::size_t>(mode)], begin, count);
      if (more < 0) return -1;
      played += more;
    }
  }
  print_message("  %d interleavings\n", played);
  return played;
}

// Each count has 8^n kinds of requests times (n+1)(n+2)/2 ways to lay them into three cycles.

// Proves RG-1, RG-3, RG-4, RG-5, RG-11.

void every_interleaving_does_what_the_rules_say(void**) {
#ifdef __SANITIZE_ADDRESS__
  assert_int_equal(play_up_to(3, OnlineMode::kForward), 5 * 5529);  // four would take minutes
#else
  assert_int_equal(play_up_to(4, OnlineMode::kForward), 5 * 66969);
#endif
}

// Proves RG-5, RG-12.

void with_points_kept_within_limits_no_interleaving_makes_a_step(void**) {
  assert_int_equal(play_up_to(3, OnlineMode::kLimit), 5 * 5529);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(every_interleaving_does_what_the_rules_say),
      cmocka_unit_test(with_points_kept_within_limits_no_interleaving_makes_a_step),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
