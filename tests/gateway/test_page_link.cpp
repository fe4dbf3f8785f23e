// Tests the page as a client of the server, in virtual time.
#include <sys/socket.h>
#include <unistd.h>

#include <string>

#include "gateway/page/page_link.hpp"
#include "tests/gateway/client_bench.hpp"

namespace tactus {
namespace {

/// The page at a server in virtual time; the bytes between them go through a pair of sockets.
struct PageBench {
  ServerBench server;
  TestClient other;
  PageLink link;
  int slot = -1, theirs = -1;
  std::uint32_t answers = 0, statuses[64] = {};
  std::string refusal;  // the first
  double override = -1.0;
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
    }
    if (message.which_message != tactus_ToClient_answer_tag) return;
    const tactus_Answer& answer = message.message.answer;
    statuses[answer.number % 64] = answer.status;
    if (answer.status != 0 && refusal.empty()) refusal = answer.text;
    ++answers;
  }
};

PageBench& fresh() {
  static PageBench* bench = nullptr;
  delete bench;
  bench = new PageBench;
  bench->start();
  return *bench;
}

// Proves PAGE-5.

void a_command_leaves_the_lease_as_free_as_it_was(void**) {
  PageBench& bench = fresh();
  const std::uint32_t number = bench.link.send(PageCommand::kOverride, 0.25);
  for (int i = 0; i < 100; ++i) bench.turn();
  for (std::uint32_t i = number - 1; i <= number + 1; ++i) assert_int_equal(bench.statuses[i], 0);
  assert_int_equal(bench.server.server.owner(), Lease::kNobody);
}

void another_clients_lease_is_not_taken_away(void**) {
  PageBench& bench = fresh();
  bench.other.lease(0, 60'000);
  bench.turn();
  const auto status_of = [&](PageCommand command, double rate) {
    bench.refusal.clear();
    const std::uint32_t number = bench.link.send(command, rate);
    assert_true(number != 0);
    for (int i = 0; i < 100; ++i) bench.turn();
    return bench.statuses[number % 64];
  };
  constexpr auto kRefused = static_cast<std::uint32_t>(Status::kNotOwner);
  assert_int_equal(status_of(PageCommand::kOverride, 0.5), 0);
  assert_int_equal(status_of(PageCommand::kPause, 0.0), 0);
  for (const PageCommand command :
       {PageCommand::kOverride, PageCommand::kResume, PageCommand::kRearm}) {
    assert_int_equal(status_of(command, 0.6), kRefused);
    assert_true(bench.refusal.find("other") != std::string::npos);
  }
  assert_int_equal(bench.server.server.owner(), bench.other.slot);
}

void stop_needs_no_lease(void**) {
  PageBench& bench = fresh();
  bench.other.lease(255, 60'000);
  bench.turn();
  const std::uint32_t number = bench.link.send(PageCommand::kStop, 0.0);
  for (int i = 0; i < 100; ++i) bench.turn();
  assert_int_equal(bench.statuses[number], 0);
  assert_int_equal(bench.rung, static_cast<int>(Rung::kDisabled));
}

void the_page_is_not_cut_as_silent_and_notices_a_server_that_ends(void**) {
  PageBench& bench = fresh();
  for (int i = 0; i < 20'000; ++i) bench.turn();  // 20 s
  assert_true(bench.link.there());
  close(bench.theirs);
  bench.link.work(bench.server.now_ns, [](const tactus_ToClient&) {});
  assert_false(bench.link.there());
  assert_int_equal(bench.link.send(PageCommand::kStop, 0.0), 0);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_command_leaves_the_lease_as_free_as_it_was),
      cmocka_unit_test(another_clients_lease_is_not_taken_away),
      cmocka_unit_test(stop_needs_no_lease),
      cmocka_unit_test(the_page_is_not_cut_as_silent_and_notices_a_server_that_ends),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
