// Clients: the connections of a server, and the messages that it sends to them. One message is
// written at a time, in fixed memory. A client that does not read is marked, and the server cuts
// it.
#pragma once

#include "gateway/server/codec.hpp"
#include "gateway/server/connection.hpp"
#include "gateway/server/lease.hpp"
#include "gateway/server/reference_intake.hpp"
#include "gateway/verdict_text.hpp"

namespace tactus {

/// Result of a request: kOk, or the reason of a refusal in words, and the number that it is about.
struct Reply {
  Status status = Status::kOk;
  Message text;
  Verdict verdict;

  Reply() = default;
  Reply(Status why, std::string_view words) : status(why), text(words) {}
};
/// Returns the reply to a reference or control with its verdict, in words with the remedy. [any]
Reply reply_to(const Verdict& verdict, VerdictAxes axes);

class Clients {
 public:
  /// `write_log` takes a line of the log; null: there is no log.
  Clients(const References& references, const StopCount& stops, void (*write_log)(const char* line))
      : references_(references), stops_(stops), log_(write_log) {}

  Connection& at(int slot) { return connections_[static_cast<std::size_t>(slot)]; }
  const Connection& at(int slot) const { return connections_[static_cast<std::size_t>(slot)]; }
  auto begin() { return connections_.begin(); }
  auto end() { return connections_.end(); }
  /// The connection of a message's sender; null if it has ended.
  Connection* sender(const Origin& from);

  /// Empties the message, which is then of this kind.
  tactus_ToClient& begin_message(pb_size_t kind);
  /// Sends the message. False: there is no space.
  bool put(Connection& to);
  /// The bytes of the message, without its length.
  Bytes encoded() { return {bytes_.data(), encode(message_, bytes_)}; }

  /// Answers a message. There is always space: messages are taken while the reserve is free.
  void answer(Connection& to, std::uint32_t number, const Reply& reply, std::int64_t now_ns);
  /// Writes a line into the log.
  void log(const char* line) const {
    if (log_ != nullptr) log_(line);
  }
  /// Sends an event to all clients that have subscribed to events, but one; -1: to all. A client
  /// whose reserve is in use loses it.
  void send_event(std::string_view name, Status status, std::string_view text, std::int64_t now_ns,
                  int except = -1);
  /// Writes the text into the log, and sends it as an event.
  void announce(std::string_view name, Status status, const char* text, std::int64_t now_ns,
                int except = -1) {
    log(text);
    send_event(name, status, text, now_ns, except);
  }
  /// Sends a report to its client, if it is still connected; `zero`: the new zero of a tare. No
  /// report may be lost: a client without space for it is marked as slow.
  void report(const ClientReport& report, std::string_view text, std::int64_t now_ns,
              const Vector6* zero = nullptr);

 private:
  const References& references_;
  const StopCount& stops_;
  void (*log_)(const char* line);
  std::array<Connection, kMostClients> connections_{};
  tactus_ToClient message_;
  std::array<std::uint8_t, kLongestToClient> bytes_;
};

}  // namespace tactus
