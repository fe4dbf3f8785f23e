#include "gateway/ctl/client.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "gateway/sockets/address.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ctl {
namespace {

constexpr int kSilence_ms = 2000;  // of the 5 s within which a client must send a message

}  // namespace

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

bool final(Report::Outcome outcome) {
  return outcome >= Report::SUCCEEDED;
}

bool succeeded(Report::Outcome outcome) {
  return outcome == Report::SUCCEEDED || outcome == Report::EXECUTED;
}

bool Client::refuse(const std::string& text) {
  exit_code_ = kRefused;
  output_.error(text, exit_code_);
  return false;
}

bool Client::lose(const std::string& reason) {
  if (!gone()) {
    exit_code_ = kNoConnection;
    output_.error(reason, exit_code_);
  }
  return false;
}

bool Client::connect() {
  const std::string address =
      options_.connect.empty() ? default_address().c_str() : options_.connect;
  if (!connection_.open(address, options_.timeout_ms)) return lose(connection_.error());
  if (!options_.key.empty() && !connection_.encrypt(options_.key, options_.timeout_ms))
    return lose(connection_.error());
  ToServer request;
  request.mutable_hello()->set_version(VERSION_PRESENT);
  request.mutable_hello()->set_client(options_.name);
  if (!ask(request)) return false;
  if (welcome_.version() != VERSION_PRESENT)
    return refuse("the server speaks version " + std::to_string(welcome_.version()) +
                  " of the protocol, this program version " + std::to_string(VERSION_PRESENT) +
                  "; install the same release at both ends");
  return true;
}

ToServer Client::lease_request(int priority) const {
  ToServer request;
  Lease& lease = *request.mutable_lease();
  lease.set_wish(Lease::TAKE);
  lease.set_priority(static_cast<std::uint32_t>(priority));
  lease.set_timeout_ms(static_cast<std::uint32_t>(options_.lease_ms));
  return request;
}

bool Client::take_lease() {
  ToServer request = lease_request(options_.priority);
  leased_ = ask(request);
  return leased_;
}

bool Client::take_free_lease() {
  ToServer request = lease_request(0);  // priority 0 takes it from no other client
  const bool answered = exchange(request);
  leased_ = answered && answer_.status() == 0;
  return answered;
}

void Client::release_lease() {
  if (!leased_ || gone()) return;
  leased_ = false;
  on_message = [](const ToClient&) {};
  ToServer request;
  request.mutable_lease()->set_wish(Lease::RELEASE);
  exchange(request);  // refused: the lease was lost before, which was reported
}

std::uint32_t Client::post(ToServer& request) {
  request.set_number(++number_);
  sent_ns_ = now_ns();
  request.set_client_ns(sent_ns_);
  if (!connection_.send(request, options_.timeout_ms)) {
    lose(connection_.error() + "; if the arm moved, it comes to rest on its path");
    return 0;
  }
  return number_;
}

bool Client::ask(ToServer& request) {
  return exchange(request) && (answer_.status() == 0 || refuse(answer_.text()));
}

bool Client::exchange(ToServer& request) {
  answered_ = reported_ = false;
  awaited_ = post(request);
  if (awaited_ == 0) return false;
  const std::int64_t end_ns = sent_ns_ + options_.timeout_ms * kMillisecond_ns;
  while (!answered_) {
    const std::int64_t left_ms = (end_ns - now_ns()) / kMillisecond_ns;
    if (left_ms <= 0)
      return lose("the server has not answered within " + std::to_string(options_.timeout_ms) +
                  " ms; --timeout-ms waits longer, and a server with a key needs --key");
    if (!wait(static_cast<int>(left_ms))) return false;
  }
  return true;
}

bool Client::ask_and_wait(ToServer& request) {
  if (!ask(request)) return false;
  while (!reported_)
    if (!wait(-1)) return false;
  output_.result(report_, !request.has_tare());  // a refusal of a tare contains the remedy
  if (!succeeded(report_.outcome()))
    exit_code_ = report_.outcome() == Report::REFUSED ? kRefused : kEndedOtherwise;
  return exit_code_ == kSucceeded;
}

int Client::next_wait_ms(int timeout_ms) const {
  const int silence_ms = leased_ ? std::min(kSilence_ms, options_.lease_ms / 3) : kSilence_ms;
  const auto since_ms = static_cast<int>((now_ns() - sent_ns_) / kMillisecond_ns);
  const int left_ms = std::max(0, silence_ms - since_ms);
  return timeout_ms < 0 ? left_ms : std::min(timeout_ms, left_ms);
}

bool Client::keep_alive() {
  if (!welcomed_ || next_wait_ms(-1) > 0) return true;
  ToServer ping;
  ping.mutable_ping();
  return post(ping) != 0;
}

bool Client::wait(int timeout_ms, int other) {
  const std::int64_t taken = taken_;
  if (!take_all() || !keep_alive()) return false;
  if (taken_ != taken) return true;
  pollfd waiting[2] = {{connection_.descriptor(), POLLIN, 0}, {other, POLLIN, 0}};
  if (poll(waiting, 2, next_wait_ms(timeout_ms)) < 0 && errno != EINTR) return lose("poll failed");
  return take_all() && keep_alive();
}

bool Client::take_all() {
  ToClient message;
  for (;;) {
    switch (connection_.receive(message)) {
      case Connection::ReceiveResult::kNothing: return true;
      case Connection::ReceiveResult::kGone:
        return lose(connection_.error() + "; if the arm moved, it comes to rest on its path");
      case Connection::ReceiveResult::kMessage: ++taken_; handle(message);
    }
  }
}

void Client::handle(const ToClient& message) {
  stops_ = std::max(
      {stops_, message.welcome().stops(), message.answer().stops(), message.state().stops()});
  if (message.has_welcome() && !welcomed_) {
    welcome_ = message.welcome();
    welcomed_ = true;
    answer_.Clear();
    answered_ = true;
  } else if (message.has_answer() && message.answer().number() == awaited_) {
    answer_ = message.answer();
    answered_ = true;
  } else if (message.has_report() && message.report().number() == awaited_ &&
             final(message.report().outcome())) {
    report_ = message.report();
    reported_ = true;
  }
  on_message(message);
}

}  // namespace tactus::ctl
