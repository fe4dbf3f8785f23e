// Tests the page as a client of the server, in virtual time.
#include <sys/socket.h>
#include <unistd.h>

#include <string>

#include "gateway/page/command_gate.hpp"
#include "gateway/page/page_link.hpp"
#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/fresh.hpp"

namespace tactus {
namespace {

/// The page at a server in virtual time; the bytes between them go through a pair of sockets.
struct PageBench {
  ServerBench server;
  TestClient other;
  PageLink link;
  std::uint32_t ask(PageCommand command, double rate) {
    return link.send(command, rate, stops, server.now_ns);
  }
  int slot = -1, theirs = -1;
  std::uint32_t answers = 0, statuses[64] = {};
  std::string refusal;  // the first
  double override = -1.0;
  std::uint32_t stops = 0;  // that a browser has seen
  std::uint32_t rung = 99;

  void start() {
    server.start();
    other.connect(server);
    other.hello("other");
    int ends[2];
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    theirs = ends[0];
    slot = server.server.open(5, server.now_ns);
    link.open(ends[1], server.now_ns);
    for (int i = 0; i < 100; ++i) turn();
  }
  void turn() {
    const ByteSpace space = server.server.space(slot);
    const ssize_t came = recv(theirs, space.data, space.size, MSG_DONTWAIT);
    if (came > 0) server.server.received(slot, static_cast<std::size_t>(came), server.now_ns);
    server.cycle();
    const Bytes bytes = server.server.waiting(slot);
    if (bytes.size > 0) {
      assert_int_equal(send(theirs, bytes.data, bytes.size, MSG_DONTWAIT), bytes.size);
      server.server.sent(slot, bytes.size, server.now_ns);
    }
    if (server.server.finished(slot, server.now_ns)) shutdown(theirs, SHUT_RDWR);
    other.read();
    link.work(server.now_ns, [this](const tactus_ToClient& message) { take(message); });
  }
  void take(const tactus_ToClient& message) {
    if (message.which_message == tactus_ToClient_state_tag) {
      override = message.message.state.override;
      rung = message.message.state.rung;
      stops = message.message.state.stops;
    }
    if (message.which_message != tactus_ToClient_answer_tag) return;
    const tactus_Answer& answer = message.message.answer;
    statuses[answer.number % 64] = answer.status;
    if (answer.status != 0 && refusal.empty()) refusal = answer.text;
    ++answers;
  }
};

// Proves PAGE-5.

void a_command_leaves_the_lease_as_free_as_it_was(void**) {
  PageBench& bench = fresh<PageBench>();
  const std::uint32_t number = bench.ask(PageCommand::kOverride, 0.25);
  for (int i = 0; i < 100; ++i) bench.turn();
  for (std::uint32_t i = number - 1; i <= number + 1; ++i) assert_int_equal(bench.statuses[i], 0);
  assert_int_equal(bench.server.server.owner(), Lease::kNoOwner);
}

void another_clients_lease_is_not_taken_away(void**) {
  PageBench& bench = fresh<PageBench>();
  bench.other.lease(0, 60'000);
  bench.turn();
  const auto status_of = [&](PageCommand command, double rate) {
    bench.refusal.clear();
    const std::uint32_t number = bench.ask(command, rate);
    assert_true(number != 0);
    for (int i = 0; i < 100; ++i) bench.turn();
    return bench.statuses[number % 64];
  };
  constexpr auto kRefused = static_cast<std::uint32_t>(Status::kNotOwner);
  assert_int_equal(status_of(PageCommand::kOverride, 0.5), 0);
  assert_int_equal(status_of(PageCommand::kPause, 0.0), 0);
  for (const PageCommand command :
       {PageCommand::kOverride, PageCommand::kResume, PageCommand::kRearm, PageCommand::kTare}) {
    assert_int_equal(status_of(command, 0.6), kRefused);
    assert_true(bench.refusal.find("other") != std::string::npos);
  }
  assert_int_equal(bench.server.server.owner(), bench.other.slot);
}

/// The page's own commands count as known, before a browser has seen a state of after them.
void what_a_browser_sent_before_it_saw_anothers_stop_is_refused(void**) {
  for (const bool others : {false, true}) {
    PageBench& bench = fresh<PageBench>();
    const std::uint32_t seen = bench.stops;
    if (others)
      bench.other.send(ask::kPause);
    else
      bench.ask(PageCommand::kPause, 0.0);
    for (int i = 0; i < 100; ++i) bench.turn();
    assert_true(bench.stops > seen);
    bench.stops = seen;
    const std::uint32_t number = bench.ask(PageCommand::kResume, 0.0);
    for (int i = 0; i < 100; ++i) bench.turn();
    assert_int_equal(bench.statuses[number % 64],
                     others ? static_cast<int>(Status::kEpochVoid) : 0);
  }
}

void stop_needs_no_lease(void**) {
  PageBench& bench = fresh<PageBench>();
  bench.other.lease(255, 60'000);
  bench.turn();
  const std::uint32_t number = bench.ask(PageCommand::kStop, 0.0);
  for (int i = 0; i < 100; ++i) bench.turn();
  assert_int_equal(bench.statuses[number], 0);
  assert_int_equal(bench.rung, static_cast<int>(Rung::kDisabled));
}

// Proves PAGE-8.

void stops_in_flight_are_one_and_a_stop_behind_another_command_is_a_new_one(void**) {
  PageBench& bench = fresh<PageBench>();
  const std::uint32_t first = bench.ask(PageCommand::kStop, 0.0);
  for (int i = 0; i < 10'000; ++i) assert_int_equal(bench.ask(PageCommand::kStop, 0.0), first);
  for (int i = 0; i < 100; ++i) bench.turn();
  assert_true(bench.link.there());
  const std::uint32_t second = bench.ask(PageCommand::kStop, 0.0);
  assert_true(second > first);
  assert_true(bench.ask(PageCommand::kRearm, 0.0) > second);
  assert_true(bench.ask(PageCommand::kStop, 0.0) > second);
  for (int i = 0; i < 100; ++i) bench.turn();
  assert_int_equal(bench.rung, static_cast<int>(Rung::kDisabled));
}

void the_share_of_the_page_does_not_come_near_what_the_server_takes(void**) {
  PageBench& bench = fresh<PageBench>();
  CommandGate gate;
  const std::uint32_t begin = bench.ask(PageCommand::kPause, 0.0);
  constexpr int kTurns = 5000, kTries = 12;
  const std::int64_t from_ns = bench.server.now_ns;
  for (int i = 0; i < kTurns; ++i) {
    for (int k = 0; k < kTries; ++k) {
      const std::int64_t now_ms = bench.server.now_ns / kMillisecond_ns;
      const auto command = k % 2 == 0 ? PageCommand::kStop : PageCommand::kPause;
      if (gate.judge(command, -1, now_ms).status == 200) bench.ask(command, 0.5);
    }
    bench.turn();
  }
  const double span_s = static_cast<double>(bench.server.now_ns - from_ns) * 1e-9;
  assert_true(bench.link.there());
  assert_true((bench.ask(PageCommand::kPause, 0.0) - begin) / span_s < 0.5 * kMessagesPerSecond);
}

// Proves PAGE-5.

void the_page_is_not_cut_as_silent_and_notices_a_server_that_ends(void**) {
  PageBench& bench = fresh<PageBench>();
  for (int i = 0; i < 20'000; ++i) bench.turn();  // 20 s
  assert_true(bench.link.there());
  close(bench.theirs);
  bench.link.work(bench.server.now_ns, [](const tactus_ToClient&) {});
  assert_false(bench.link.there());
  assert_int_equal(bench.ask(PageCommand::kStop, 0.0), 0);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_command_leaves_the_lease_as_free_as_it_was),
      cmocka_unit_test(another_clients_lease_is_not_taken_away),
      cmocka_unit_test(what_a_browser_sent_before_it_saw_anothers_stop_is_refused),
      cmocka_unit_test(stop_needs_no_lease),
      cmocka_unit_test(stops_in_flight_are_one_and_a_stop_behind_another_command_is_a_new_one),
      cmocka_unit_test(the_share_of_the_page_does_not_come_near_what_the_server_takes),
      cmocka_unit_test(the_page_is_not_cut_as_silent_and_notices_a_server_that_ends),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
