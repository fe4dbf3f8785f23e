// Tests the kernel's lock-free code on a model of a machine with weak memory, in every execution
// that its memory orders allow; a sanitizer sees only the executions of this processor. Each memory
// order of the code is then relaxed in turn, and the test must fail.
#include "kernel/core/mailbox.hpp"
#include "kernel/core/ring_positions.hpp"
#include "kernel/cycle/event_log.hpp"
#include "tests/support/trials.hpp"
#include "tests/support/weak_memory.hpp"

namespace tactus {
namespace {

using weak::Explored;
using weak::Memory;
using weak::Plain;
using weak::Weakened;

constexpr std::size_t kWriter = 0, kReader = 1;

/// Every weakened order must produce an error, and the code as written none.
template <class Run>
void assert_orders_are_enough_and_needed(Run run, std::initializer_list<Weakened> needed) {
  const Explored as_written = weak::explore({}, run);
  print_message("%lld runs\n", static_cast<long long>(as_written.runs));
  assert_int_equal(as_written.wrong, 0);
  assert_true(as_written.runs > 100);
  for (const Weakened& order : needed) assert_int_equal(weak::explore(order, run).wrong, 1);
}

// Proves LAD-8.

constexpr std::uint32_t kEvents = tries(6, 4);
constexpr std::size_t kWords = sizeof(Event) / sizeof(std::uint32_t);

/// No two events have a word in common.
Event event_of(std::uint32_t number) {
  const auto n = static_cast<std::uint8_t>(number + 1);
  Event event;
  event.stamp_ns = std::int64_t{n} << 32 | (n + 16);
  event.cycle = n + 32U;
  event.value = n + 48.0F;
  event.status = static_cast<Status>(n);
  event.cause = static_cast<Cause>(n);
  event.from = event.to = static_cast<Rung>(n % kRungs);
  event.joint = static_cast<std::int8_t>(n);
  return event;
}

bool same(const Event& a, const Event& b) {
  return a.stamp_ns == b.stamp_ns && a.cycle == b.cycle && a.value == b.value &&
         a.status == b.status && a.cause == b.cause && a.from == b.from && a.to == b.to &&
         a.joint == b.joint;
}

int g_told = 0;

/// The cycle adds events while a reader reads one of them, at any moment.
template <std::uint32_t size>
bool an_event_is_told_as_it_was(Memory& memory) {
  EventLogOf<weak::Atomic, size> log;
  memory.begin();
  memory.run(kWriter);
  for (std::uint32_t i = 0; i < kEvents; ++i) log.add(event_of(i));
  memory.run(kReader);
  const auto number = static_cast<std::uint32_t>(memory.choose(kEvents));
  Event event;
  if (!log.read(number, event)) return true;
  ++g_told;
  return same(event, event_of(number));
}

template <std::uint32_t size>
void assert_events_are_whole() {
  constexpr std::size_t kBegun = size * kWords, kAdded = kBegun + 1;
  g_told = 0;
  assert_int_equal(weak::explore({}, an_event_is_told_as_it_was<size>).wrong, 0);
  assert_true(g_told >= static_cast<int>(kEvents));
  assert_orders_are_enough_and_needed(an_event_is_told_as_it_was<size>,
                                      {{0, kBegun, true},
                                       {0, kBegun, false},
                                       {kAdded, kAdded + 1, true},
                                       {kAdded, kAdded + 1, false}});
}

void an_event_that_is_read_is_whole_and_the_one_asked_for(void**) {
  assert_events_are_whole<1>();
  assert_events_are_whole<2>();
}

// A ring constructs the writer's position first, then the reader's.
constexpr std::initializer_list<Weakened> kPositions = {
    {0, 1, true}, {0, 1, false}, {1, 2, true}, {1, 2, false}};
// Calls of writer and reader, in every order; six show every weakened order too.
constexpr int kCalls = tries(9, 6);

// Proves REC-1.

template <std::uint32_t rows>
bool rows_come_out_in_order(Memory& memory) {
  RingPositions<weak::Atomic> positions;
  std::array<Plain, rows> ring;
  positions.start(rows);
  memory.begin();
  int sent = 0, taken = 0;
  for (int i = 0; i < kCalls; ++i) {
    std::uint32_t row = 0;
    memory.run(memory.choose(2));
    if (memory.thread() == kWriter) {
      if (!positions.to_write(row)) continue;
      ring[row].write(++sent);
      positions.written();
    } else {
      if (!positions.to_read(row)) continue;
      if (ring[row].read() != ++taken) return false;
      positions.was_read();
    }
  }
  return taken <= sent;
}

void a_row_of_the_recorder_is_written_before_it_is_read_and_read_before_it_is_overwritten(void**) {
  assert_orders_are_enough_and_needed(rows_come_out_in_order<1>, kPositions);
  assert_orders_are_enough_and_needed(rows_come_out_in_order<2>, kPositions);
}

// Proves KER-4.

bool messages_come_out_in_order(Memory& memory) {
  Mailbox<Plain, 2, weak::Atomic> mailbox;
  memory.begin();
  int sent = 0, taken = 0;
  for (int i = 0; i < kCalls; ++i) {
    Plain message;
    memory.run(memory.choose(2));
    if (memory.thread() == kWriter) {
      message.write(sent + 1);
      sent += mailbox.post(message) ? 1 : 0;
    } else if (mailbox.take(message) && message.read() != ++taken) {
      return false;
    }
  }
  return taken <= sent;
}

void a_message_is_written_before_it_is_read_and_read_before_it_is_overwritten(void**) {
  assert_orders_are_enough_and_needed(messages_come_out_in_order, kPositions);
}

// Proves LAD-8, REC-1, KER-4.

/// Checks the machine itself by known results of small programs: x and y are stored one after the
/// other, y is loaded before x.
void the_machine_allows_what_the_memory_model_does(void**) {
  constexpr auto kRelaxed = std::memory_order_relaxed;
  for (const bool releases : {false, true}) {
    for (const bool acquires : {false, true}) {
      int seen = 0;  // bit 2 y + x is set if some run loaded these values
      weak::explore({}, [&](Memory& memory) {
        weak::Atomic<int> x, y;
        memory.begin();
        memory.run(kWriter);
        x.store(1, kRelaxed);
        y.store(1, releases ? std::memory_order_release : kRelaxed);
        memory.run(kReader);
        const int b = y.load(acquires ? std::memory_order_acquire : kRelaxed);
        const int a = x.load(kRelaxed);
        assert_true(x.load(kRelaxed) >= a);  // coherence
        seen |= 1 << (2 * b + a);
        return true;
      });
      assert_int_equal(seen, releases && acquires ? 0b1011 : 0b1111);
    }
  }
}

void the_machine_sees_a_race_whatever_comes_first(void**) {
  for (const std::size_t first : {kWriter, kReader}) {
    for (const bool both_read : {false, true}) {
      const Explored raced = weak::explore({}, [&](Memory& memory) {
        Plain number;
        const auto step = [&](bool writes) {
          if (writes && !both_read)
            number.write(1);
          else
            static_cast<void>(number.read());
        };
        memory.begin();
        memory.run(first);
        step(first == kWriter);
        memory.run(1 - first);
        step(first == kReader);
        return true;
      });
      assert_int_equal(raced.wrong, both_read ? 0 : 1);
    }
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_machine_allows_what_the_memory_model_does),
      cmocka_unit_test(the_machine_sees_a_race_whatever_comes_first),
      cmocka_unit_test(an_event_that_is_read_is_whole_and_the_one_asked_for),
      cmocka_unit_test(
          a_row_of_the_recorder_is_written_before_it_is_read_and_read_before_it_is_overwritten),
      cmocka_unit_test(a_message_is_written_before_it_is_read_and_read_before_it_is_overwritten),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
