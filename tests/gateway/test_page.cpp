// Tests the parts of the page without HTTP: what a request is judged by, what browsers are told,
// and the page as a client of the server, in virtual time.
#include <sys/socket.h>

#include <string>

#include "gateway/page/json.hpp"
#include "gateway/page/news.hpp"
#include "gateway/page/page_link.hpp"
#include "gateway/page/page_thread.hpp"
#include "gateway/page/request_check.hpp"
#include "tests/gateway/client_bench.hpp"

namespace tactus {
namespace {

constexpr std::string_view kToken = "00112233445566778899aabbccddeeff";

int status_of(const RequestHead& head) {
  return judge_request(head, kToken).status;
}

// Proves PAGE-3.

void only_names_of_this_computer_are_hosts(void**) {
  for (const char* host : {"localhost", "127.0.0.1", "localhost:7380", "127.0.0.1:1"})
    assert_true(own_host(host));
  for (const char* host :
       {"", ":7380", "localhost.", "localhost:x", "127.0.0.1.example", "127.0.0.2", "example:7380",
        "localhost:80:80", "0.0.0.0", "[::1]", "localhost@example"})
    assert_false(own_host(host));
}

void what_acts_needs_the_method_the_origin_and_the_token(void**) {
  const RequestHead good = {"POST", "/stop", "localhost:7380", "http://localhost:7380", kToken};
  assert_int_equal(status_of(good), 200);
  RequestHead head = good;
  head.origin = {};
  assert_int_equal(status_of(head), 200);
  for (const char* origin : {"http://localhost", "https://localhost:7380", "http://example", "null",
                             "http://localhost:7380.example", "http:/"}) {
    head.origin = origin;
    assert_int_equal(status_of(head), 403);
  }
  head = good;
  for (const std::string_view token :
       {std::string_view(), kToken.substr(1), kToken.substr(0, 31)}) {
    head.token = token;
    assert_int_equal(status_of(head), 403);
  }
  head = good;
  head.method = "GET";
  assert_int_equal(status_of(head), 405);
  head.path = "/begin";
  assert_int_equal(status_of(head), 404);
}

// Proves PAGE-2.

void an_address_that_other_computers_reach_is_refused_with_the_remedy(void**) {
  Address address;
  Message why;
  assert_true(parse_page_address("127.0.0.1:7380", address, why));
  for (const char* text : {"0.0.0.0:7380", "192.168.1.5:7380"}) {
    why = {};
    assert_false(parse_page_address(text, address, why));
    assert_non_null(std::strstr(why.c_str(), "ssh -L PORT:127.0.0.1:PORT"));
  }
  for (const char* text : {"", "7380", "localhost:7380", "127.0.0.1:", "unix:/tmp/page"})
    assert_false(parse_page_address(text, address, why));
}

// Proves PAGE-1.

void numbers_and_texts_are_json_whatever_they_are(void**) {
  char bytes[120];
  Json json(bytes, sizeof bytes);
  const double values[] = {0.0, -1.5, 1e-300, std::nan(""), kInfinity};
  json.open('{').numbers("v", values, 5).string("a\"b\\c\n\xff", "s").integer(-7, "i");
  json.flag(true, "f").open('[', "e").close(']').close('}');
  assert_string_equal(std::string(json.text()).c_str(),
                      "{\"v\":[0,-1.5,1e-300,null,null],\"s\":\"a\\\"b\\\\c??\",\"i\":-7,"
                      "\"f\":true,\"e\":[]}");
}

void what_does_not_fit_is_not_told_in_part(void**) {
  char bytes[8];
  Json json(bytes, sizeof bytes);
  json.open('{').integer(12345, "key").close('}');
  assert_true(json.text().empty());
}

// Proves PAGE-4.

void a_browser_reads_the_news_at_its_own_pace_until_it_has_lost_some(void**) {
  static News news;
  news.tell("first", "1");
  const std::uint64_t from = news.end();
  std::string told, read;
  for (int i = 0; told.size() + 40 < kNewsBytes; ++i) {
    const std::string data = std::to_string(i);
    news.tell("state", data);
    told += "event: state\ndata: " + data + "\n\n";
  }
  assert_true(news.holds(from));
  char piece[1000];
  for (std::uint64_t at = from; at < news.end();) {
    const std::size_t count = news.read(at, piece, sizeof piece);
    read.append(piece, count);
    at += count;
  }
  assert_true(read == told);
  news.tell("state", std::string(40, 'x'));
  assert_false(news.holds(from));
}

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
    other.bench = &server;
    other.greet("other");
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
  std::uint32_t first = 0;
  assert_int_equal(bench.link.send(PageCommand::kOverride, 0.25, first), 3);
  for (int i = 0; i < 100; ++i) bench.turn();
  for (std::uint32_t i = 0; i < 3; ++i) assert_int_equal(bench.statuses[first + i], 0);
  assert_int_equal(bench.server.server.owner(), Lease::kNobody);
}

void another_clients_lease_is_not_taken_away(void**) {
  PageBench& bench = fresh();
  bench.other.lease(0, 60'000);
  bench.turn();
  const std::uint32_t epoch = bench.server.server.epoch();
  for (const PageCommand command :
       {PageCommand::kOverride, PageCommand::kPause, PageCommand::kResume, PageCommand::kCancel,
        PageCommand::kRearm}) {
    std::uint32_t first = 0;
    bench.refusal.clear();
    assert_int_equal(bench.link.send(command, 0.5, first), 3);
    for (int i = 0; i < 100; ++i) bench.turn();
    for (std::uint32_t i = 0; i < 3; ++i)
      assert_int_equal(bench.statuses[first + i], static_cast<int>(Status::kNotOwner));
    assert_true(bench.refusal.find("other") != std::string::npos);
  }
  assert_int_equal(bench.server.server.owner(), bench.other.slot);
  assert_int_equal(bench.server.server.epoch(), epoch);
}

void stop_needs_no_lease(void**) {
  PageBench& bench = fresh();
  bench.other.lease(255, 60'000);
  bench.turn();
  std::uint32_t first = 0;
  assert_int_equal(bench.link.send(PageCommand::kStop, 0.0, first), 1);
  for (int i = 0; i < 100; ++i) bench.turn();
  assert_int_equal(bench.statuses[first], 0);
  assert_int_equal(bench.rung, static_cast<int>(Rung::kDisabled));
}

void the_page_is_not_cut_as_silent_and_notices_a_server_that_ends(void**) {
  PageBench& bench = fresh();
  for (int i = 0; i < 20'000; ++i) bench.turn();  // 20 s
  assert_true(bench.link.there());
  close(bench.theirs);
  bench.link.work(bench.server.now_ns, [](const tactus_ToClient&) {});
  assert_false(bench.link.there());
  std::uint32_t first = 0;
  assert_int_equal(bench.link.send(PageCommand::kStop, 0.0, first), 0);
}

void bodies_that_are_no_rate_are_refused(void**) {
  double rate = -1.0;
  for (const char* body : {"0", "1", "0.5", "1e-3"})
    assert_true(read_body(PageCommand::kOverride, body, rate));
  for (const char* body : {"", "-0.1", "1.0001", "nan", "inf", "0.5 ", " 0.5", "0x1", "0,5", "1 1"})
    assert_false(read_body(PageCommand::kOverride, body, rate));
  assert_true(read_body(PageCommand::kStop, "", rate));
  assert_false(read_body(PageCommand::kStop, "0", rate));
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(only_names_of_this_computer_are_hosts),
      cmocka_unit_test(what_acts_needs_the_method_the_origin_and_the_token),
      cmocka_unit_test(an_address_that_other_computers_reach_is_refused_with_the_remedy),
      cmocka_unit_test(numbers_and_texts_are_json_whatever_they_are),
      cmocka_unit_test(what_does_not_fit_is_not_told_in_part),
      cmocka_unit_test(a_browser_reads_the_news_at_its_own_pace_until_it_has_lost_some),
      cmocka_unit_test(a_command_leaves_the_lease_as_free_as_it_was),
      cmocka_unit_test(another_clients_lease_is_not_taken_away),
      cmocka_unit_test(stop_needs_no_lease),
      cmocka_unit_test(the_page_is_not_cut_as_silent_and_notices_a_server_that_ends),
      cmocka_unit_test(bodies_that_are_no_rate_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
