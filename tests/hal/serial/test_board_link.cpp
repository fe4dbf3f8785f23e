// The board's end of the link: messages are executed once however often they come.
#include <algorithm>
#include <vector>

#include "hal/serial/board_link.hpp"
#include "tests/support/testing.hpp"

namespace tactus::serial {
namespace {

class Wire final : public ByteLink {
 public:
  std::size_t receive(std::uint8_t* to, std::size_t capacity) override {
    const std::size_t size = std::min(capacity, in.size());
    std::copy(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(size), to);
    in.erase(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(size));
    return size;
  }
  void send(const std::uint8_t* bytes, std::size_t size) override {
    for (std::size_t i = 0; i < size; ++i)
      if (reader.take(bytes[i])) answers.push_back(reader.frame().number);
  }
  void put(Kind kind, std::uint16_t number, const std::vector<std::uint8_t>& payload = {}) {
    std::uint8_t bytes[kMaxFrame];
    const std::size_t size = write_frame({kind, number, payload.data(), payload.size()}, bytes);
    in.insert(in.end(), bytes, bytes + size);
  }

  std::vector<std::uint8_t> in;
  std::vector<int> answers;  // numbers of the frames that were sent
  FrameReader reader;
};

Wire g_wire;

BoardLink& fresh() {
  static BoardLink* link = nullptr;
  delete link;
  g_wire = Wire();
  link = new BoardLink(g_wire);
  return *link;
}

/// Executes a message, if one waits; returns its number or -1.
int execute(BoardLink& link) {
  Frame frame;
  if (!link.message(frame)) return -1;
  link.answer(Status::kOk).u8(42);
  link.answered();
  return frame.number;
}

// Proves LNK-3.
void a_message_that_comes_twice_is_executed_once_and_answered_twice(void**) {
  BoardLink& link = fresh();
  for (int i = 0; i < 2; ++i) {
    g_wire.put(Kind::kPoint, 9, {1});
    link.poll();
    assert_int_equal(execute(link), i == 0 ? 9 : -1);
    link.send_answer();
  }
  assert_true(g_wire.answers == std::vector<int>({9, 9}));
  g_wire.put(Kind::kPoint, 10, {1});
  link.poll();
  assert_int_equal(execute(link), 10);
}

void a_message_before_the_last_is_answered_is_dropped_and_comes_again(void**) {
  BoardLink& link = fresh();
  g_wire.put(Kind::kPoint, 1);
  g_wire.put(Kind::kPoint, 2);
  link.poll();
  assert_int_equal(execute(link), 1);
  assert_int_equal(execute(link), -1);
  link.send_answer();
  g_wire.put(Kind::kPoint, 2);
  link.poll();
  assert_int_equal(execute(link), 2);
  link.send_answer();
  assert_true(g_wire.answers == std::vector<int>({1, 2}));
}

void a_hello_is_always_answered_anew(void**) {
  BoardLink& link = fresh();
  for (int i = 0; i < 3; ++i) {
    g_wire.put(Kind::kHello, 1);
    link.poll();
    assert_int_equal(execute(link), 1);
    link.send_answer();
  }
  assert_int_equal(g_wire.answers.size(), 3);
}

void the_newest_state_counts_and_a_tick_begins_one_cycle(void**) {
  BoardLink& link = fresh();
  CycleTime now;
  g_wire.put(Kind::kState, 0, {1, 2});
  g_wire.put(Kind::kState, 1, {3, 4, 5});
  g_wire.put(Kind::kTick, 2, {0, 0, 0, 0, 0, 0, 1, 2});
  link.poll();
  ByteReader state = link.state();
  assert_int_equal(state.left(), 3);
  assert_int_equal(state.u8(), 3);
  assert_int_equal(link.state().left(), 0);
  assert_true(link.tick(now));
  assert_int_equal(now.stamp_ns, 258);
  assert_false(link.tick(now));
}

void frames_that_it_does_not_know_are_counted(void**) {
  BoardLink& link = fresh();
  CycleTime now;
  g_wire.put(Kind::kTick, 0, {1, 2, 3});
  g_wire.put(Kind::kState, 0, std::vector<std::uint8_t>(1000, 1));
  g_wire.put(static_cast<Kind>(200), 0, {1});
  g_wire.put(Kind::kAnswer, 0, {1});
  link.poll();
  assert_int_equal(link.refused(), 4);
  assert_false(link.tick(now));
  assert_int_equal(link.state().left(), 0);
}

}  // namespace
}  // namespace tactus::serial

int main() {
  using namespace tactus::serial;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_message_that_comes_twice_is_executed_once_and_answered_twice),
      cmocka_unit_test(a_message_before_the_last_is_answered_is_dropped_and_comes_again),
      cmocka_unit_test(a_hello_is_always_answered_anew),
      cmocka_unit_test(the_newest_state_counts_and_a_tick_begins_one_cycle),
      cmocka_unit_test(frames_that_it_does_not_know_are_counted),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
