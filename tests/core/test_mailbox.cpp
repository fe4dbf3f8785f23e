// Tests Mailbox: messages come out once and in order, and a full mailbox refuses the next. The last
// test runs two threads at full speed; build it with SANITIZE=thread to check the memory order too.
#include "kernel/core/mailbox.hpp"

#include <thread>

#include "tests/support/testing.hpp"

namespace tactus {
namespace {

// Proves KER-4.

void a_new_mailbox_is_empty(void**) {
  Mailbox<int, 4> box;
  int message = 7;
  assert_false(box.take(message));
  assert_int_equal(message, 7);
  assert_int_equal(box.space(), 4);
  assert_int_equal(box.capacity(), 4);
}

void messages_come_out_in_the_order_they_went_in(void**) {
  Mailbox<int, 4> box;
  for (int i = 1; i <= 4; ++i) assert_true(box.post(i));
  int message = 0;
  for (int i = 1; i <= 4; ++i) {
    assert_true(box.take(message));
    assert_int_equal(message, i);
  }
  assert_false(box.take(message));
}

void a_full_mailbox_refuses_and_keeps_what_it_has(void**) {
  Mailbox<int, 2> box;
  assert_true(box.post(1));
  assert_true(box.post(2));
  assert_false(box.post(3));
  int message = 0;
  assert_true(box.take(message));
  assert_int_equal(message, 1);
  assert_true(box.post(4));
  assert_true(box.take(message));
  assert_int_equal(message, 2);
  assert_true(box.take(message));
  assert_int_equal(message, 4);
  assert_false(box.take(message));
}

void space_is_what_can_still_be_posted(void**) {
  Mailbox<int, 8> box;
  int message = 0;
  for (int round = 0; round < 100; ++round) {  // several times around the ring
    for (std::size_t space = 8; space > 0; --space) {
      assert_int_equal(box.space(), space);
      assert_true(box.post(round));
    }
    assert_int_equal(box.space(), 0);
    for (std::size_t space = 1; space <= 8; ++space) {
      assert_true(box.take(message));
      assert_int_equal(box.space(), space);
    }
  }
}

/// Longer than a machine word, so that a torn copy is visible: its two halves disagree.
struct Numbered {
  std::uint64_t number = 0, square = 0;
};

constexpr std::uint64_t kMessages = 1000000;
Mailbox<Numbered, 1024> g_box;  // large enough that a thread rarely has to wait

void produce() {
  for (std::uint64_t number = 1; number <= kMessages;)
    if (g_box.post({number, number * number})) ++number;
}

/// The consumer's results; the test compares them outside the thread, where an assertion may jump.
struct Findings {
  std::uint64_t taken = 0, sum = 0, out_of_order = 0, torn = 0;
} g_findings;

void consume() {
  Numbered message;
  while (g_findings.taken < kMessages) {
    if (!g_box.take(message)) {
      std::this_thread::yield();  // the producer never waits
      continue;
    }
    ++g_findings.taken;
    g_findings.sum += message.number;
    g_findings.out_of_order += message.number != g_findings.taken;
    g_findings.torn += message.square != message.number * message.number;
  }
}

void a_million_messages_pass_between_two_threads_whole_and_in_order(void**) {
  {
    std::thread producer(produce);
    consume();
    producer.join();
  }
  assert_int_equal(g_findings.taken, kMessages);
  assert_int_equal(g_findings.out_of_order, 0);
  assert_int_equal(g_findings.torn, 0);
  assert_int_equal(g_findings.sum, kMessages * (kMessages + 1) / 2);
  assert_int_equal(g_box.space(), g_box.capacity());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_new_mailbox_is_empty),
      cmocka_unit_test(messages_come_out_in_the_order_they_went_in),
      cmocka_unit_test(a_full_mailbox_refuses_and_keeps_what_it_has),
      cmocka_unit_test(space_is_what_can_still_be_posted),
      cmocka_unit_test(a_million_messages_pass_between_two_threads_whole_and_in_order),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
