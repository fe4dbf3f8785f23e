// Client: the conversation of one verb with the server. It numbers requests, waits for answers,
// keeps the lease alive, and hands everything else that arrives to the verb.
#pragma once

#include <functional>
#include <string>

#include "gateway/ctl/connection.hpp"
#include "gateway/ctl/options.hpp"
#include "gateway/ctl/output.hpp"

namespace tactus::ctl {

class Client {
 public:
  Client(const Options& options, Output& output) : options_(options), output_(output) {}

  /// Connects and sends Hello. False: the reason is printed; exit_code() is kNoConnection or
  /// kRefused.
  bool connect();
  /// Takes the lease. False, with the reason printed: refused with the owner's name, or no
  /// connection.
  bool take_lease();
  /// Takes the lease if it is free. False: no connection; the reason is printed.
  bool take_free_lease();
  /// Gives the lease back: what runs continues to its end.
  void release_lease();

  /// Everything that arrives besides the answers that are awaited.
  std::function<void(const ToClient&)> on_message = [](const ToClient&) {};

  /// Sends a request. Returns its number; 0: the server is gone; printed.
  std::uint32_t post(ToServer& request);
  /// Sends a request and waits for its Answer. False: refused, or no connection; printed.
  bool ask(ToServer& request);
  /// Does the same and waits for the final Report, too, and prints it. False: it is none of
  /// success.
  bool ask_and_wait(ToServer& request);
  /// Waits until something arrives, at most `timeout_ms`, and hands it on. Also returns when a
  /// signal arrives or `other`, a descriptor, is readable. False: the server is gone; printed.
  bool wait(int timeout_ms, int other = -1);

  const Welcome& welcome() const { return welcome_; }
  /// The latest stop, cancel, pause or lower override that the server has reported, for requests
  /// after which the arm moves again.
  std::uint32_t stops() const { return stops_; }
  int exit_code() const { return exit_code_; }
  bool gone() const { return exit_code_ == kNoConnection; }
  /// Says why the verb ends; returns false.
  bool refuse(const std::string& text);

 private:
  ToServer lease_request(int priority) const;
  bool exchange(ToServer& request);
  bool lose(const std::string& reason);
  bool take_all();
  void handle(const ToClient& message);
  bool keep_alive();
  int next_wait_ms(int timeout_ms) const;

  const Options& options_;
  Output& output_;
  Connection connection_;
  Welcome welcome_;
  Answer answer_;
  Report report_;
  std::uint32_t number_ = 0, awaited_ = 0, stops_ = 0;
  std::int64_t sent_ns_ = 0, taken_ = 0;
  bool welcomed_ = false, answered_ = false, reported_ = false, leased_ = false;
  int exit_code_ = kSucceeded;
};

/// True for a final outcome.
bool final(Report::Outcome outcome);
/// True for the outcome of a request executed as sent.
bool succeeded(Report::Outcome outcome);

/// The client's monotonic clock.
std::int64_t now_ns();

}  // namespace tactus::ctl
