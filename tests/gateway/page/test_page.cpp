// Tests the parts of the page without HTTP: what a request is judged by, what browsers are told,
// and the page as a client of the server, in virtual time.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <limits>
#include <string>

#include "gateway/page/command_gate.hpp"
#include "gateway/page/event_ring.hpp"
#include "gateway/page/json.hpp"
#include "gateway/page/open_connections.hpp"
#include "gateway/page/page_command.hpp"
#include "gateway/page/page_thread.hpp"
#include "gateway/page/request_check.hpp"
#include "tests/support/testing.hpp"

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
                             "http://localhost:7380.example", "http:/", ""}) {
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

void a_header_that_is_checked_comes_once(void**) {
  for (const char* name : {"Host", "host", "ORIGIN", "X-Tactus-Token", "x-tactus-seen"}) {
    RequestHead head = {"POST", "/stop"};
    take_header("Accept", "*", head);
    take_header("Accept", "*", head);
    take_header("HOST", "localhost", head);
    take_header("origin", "http://localhost", head);
    take_header("x-tactus-token", kToken, head);
    take_header("X-TACTUS-SEEN", "12 7", head);
    assert_int_equal(status_of(head), 200);
    assert_int_equal(read_seen(head.seen).sent_ms, 12);
    assert_int_equal(read_seen(head.seen).stops, 7);
    take_header(name, "", head);
    assert_int_equal(status_of(head), 400);
  }
  RequestHead empty = {"GET", "/"};
  take_header("Host", "localhost", empty);
  take_header("Origin", "", empty);
  assert_int_equal(status_of(empty), 403);
}

// Proves PAGE-8.

void commands_of_all_browsers_have_a_share_and_stop_has_none(void**) {
  CommandGate gate;
  int taken = 0;
  for (std::int64_t ms = 1000; ms < 3000; ++ms) {
    taken += gate.judge(PageCommand::kOverride, ms, ms).status == 200 ? 1 : 0;
    taken += gate.judge(PageCommand::kPause, -1, ms).status == 200 ? 1 : 0;
    if (ms == 1999) assert_int_equal(taken, 50);
  }
  assert_int_equal(taken, 100);
  assert_int_equal(gate.judge(PageCommand::kCancel, -1, 2999).status, 429);
  assert_int_equal(gate.judge(PageCommand::kStop, -1, 2999).status, 200);
}

void what_may_raise_motion_is_refused_if_it_is_late(void**) {
  for (const PageCommand command :
       {PageCommand::kOverride, PageCommand::kResume, PageCommand::kRearm, PageCommand::kTare}) {
    CommandGate gate;
    constexpr std::int64_t kNow = 100'000, kLeast = std::numeric_limits<std::int64_t>::min();
    assert_int_equal(gate.judge(command, kNow - kOldestSeen_ms, kNow).status, 200);
    for (const std::int64_t seen : {kNow - kOldestSeen_ms - 1, kNow + 1, kLeast, std::int64_t{-1}})
      assert_int_equal(gate.judge(command, seen, kNow).status, 409);
    assert_int_equal(gate.judge(PageCommand::kStop, -1, kNow).status, 200);
    assert_int_equal(gate.judge(command, kNow, kNow + 1).status, 409);  // sent before the stop
    assert_int_equal(gate.judge(command, kNow + 1, kNow + 1).status, 200);
  }
  for (const PageCommand command : {PageCommand::kPause, PageCommand::kCancel})
    assert_int_equal(CommandGate().judge(command, -1, 100'000).status, 200);
  for (const char* text : {"", "x", "1", "1 ", "1.5 2", "1 x", "1 2 ", "1 -2", "1 4294967296",
                           "99999999999999999999 1"}) {
    assert_int_equal(read_seen(text).sent_ms, -1);
    assert_int_equal(read_seen(text).stops, 0);
  }
  for (const SeenState& seen :
       {SeenState{0, 1}, SeenState{std::numeric_limits<std::int64_t>::max(), ~std::uint32_t{0}}}) {
    std::array<char, 32> text;
    const SeenState read = read_seen(write_seen(seen, text));
    assert_true(read.sent_ms == seen.sent_ms && read.stops == seen.stops);
  }
}

// Proves PAGE-4.

void a_connection_that_takes_too_long_is_shut_down_and_earlier_if_there_is_no_place(void**) {
  OpenConnections open;
  std::array<std::array<int, 2>, kMostPageConnections> pairs;
  const auto ended = [&](std::size_t i) {
    char byte;
    return recv(pairs[i][1], &byte, 1, MSG_DONTWAIT) == 0;
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, pairs[i].data()), 0);
    if (i + 1 < pairs.size()) open.add(pairs[i][0], static_cast<std::int64_t>(i));
  }
  open.keep(pairs[1][0]);
  open.end_late(kLongestRequest_ns);
  assert_false(ended(0));
  open.end_late(kLongestRequest_ns + 1);
  assert_true(ended(0));
  assert_false(ended(1) || ended(2));
  open.add(pairs.back()[0], kLongestRequest_ns);
  open.end_late(kLongestRequest_ns + 1);
  assert_false(ended(1) || ended(pairs.size() - 1));
  assert_true(ended(2) && ended(pairs.size() - 2));
  open.remove(pairs[3][0]);
  open.end_late(2 * kLongestRequest_ns);
  assert_false(ended(pairs.size() - 1) || ended(1));
  for (const auto& pair : pairs)
    for (const int socket : pair) close(socket);
}

// Proves PAGE-2.

void an_address_that_other_computers_reach_is_refused_with_the_remedy(void**) {
  Address address;
  Message why;
  assert_true(parse_page_address("127.0.0.1:7380", address, why));
  for (const char* text : {"0.0.0.0:7380", "192.168.1.5:7380", "127.0.0.2:7380"}) {
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
  static EventRing events;
  events.append("first", "1");
  const std::uint64_t from = events.end();
  std::string told, read;
  for (int i = 0; told.size() + 40 < kEventRingBytes; ++i) {
    const std::string data = std::to_string(i);
    events.append("state", data);
    told += "event: state\ndata: " + data + "\n\n";
  }
  assert_true(events.holds(from));
  char piece[1000];
  for (std::uint64_t at = from; at < events.end();) {
    const std::size_t count = events.read(at, piece, sizeof piece);
    read.append(piece, count);
    at += count;
  }
  assert_true(read == told);
  events.append("state", std::string(40, 'x'));
  assert_false(events.holds(from));
}

// Proves PAGE-3.

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
      cmocka_unit_test(a_header_that_is_checked_comes_once),
      cmocka_unit_test(commands_of_all_browsers_have_a_share_and_stop_has_none),
      cmocka_unit_test(what_may_raise_motion_is_refused_if_it_is_late),
      cmocka_unit_test(
          a_connection_that_takes_too_long_is_shut_down_and_earlier_if_there_is_no_place),
      cmocka_unit_test(an_address_that_other_computers_reach_is_refused_with_the_remedy),
      cmocka_unit_test(numbers_and_texts_are_json_whatever_they_are),
      cmocka_unit_test(what_does_not_fit_is_not_told_in_part),
      cmocka_unit_test(a_browser_reads_the_news_at_its_own_pace_until_it_has_lost_some),
      cmocka_unit_test(bodies_that_are_no_rate_are_refused),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
