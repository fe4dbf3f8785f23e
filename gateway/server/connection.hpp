// Connection: what the server keeps of one client.
#pragma once

#include <algorithm>

#include "gateway/server/byte_queues.hpp"
#include "kernel/core/load_error.hpp"

namespace tactus {

/// Messages per time: an allowance that fills up at a rate, and that every message takes from.
class MessageRate {
 public:
  void start(std::int64_t now_ns) {
    left_ = kMessageBurst;
    at_ns_ = now_ns;
  }
  /// Counts a message; false: it is one too many.
  bool count(std::int64_t now_ns) {
    const double since_s = static_cast<double>(now_ns - at_ns_) * 1e-9;
    left_ = std::min<double>(kMessageBurst, left_ + kMessagesPerSecond * std::max(0.0, since_s));
    at_ns_ = now_ns;
    left_ -= 1.0;
    return left_ >= 0.0;
  }

 private:
  double left_ = 0.0;
  std::int64_t at_ns_ = 0;
};

/// Messages that a client has subscribed to, of one kind.
struct Subscription {
  std::int64_t period_ns = 0, due_ns = 0;  ///< 0: none

  /// True once in every period, at most.
  bool due(std::int64_t now_ns) {
    if (period_ns == 0 || now_ns < due_ns) return false;
    due_ns = std::max(due_ns + period_ns, now_ns - period_ns);
    return true;
  }
};

struct Connection {
  enum class State : std::uint8_t {
    kFree,
    kNew,  ///< no Hello yet
    kOpen,
    kLeaving,  ///< it is cut: the last messages to it are being sent
  };

  State state = State::kFree;
  std::uint64_t session = 0;
  Name name;
  std::int64_t heard_ns = 0;     ///< arrival of its last bytes, or its opening or cut
  std::int64_t asked_ns = 0;     ///< arrival of its last message other than Ping, or its opening
  std::int64_t read_ns = 0;      ///< when it last read something, or nothing waited for it
  std::int64_t client_ns = 0;    ///< of its last message
  std::int64_t received_ns = 0;  ///< its arrival
  MessageRate rate;
  Subscription states, feedback;
  bool events = false;
  std::uint32_t epoch = 0, sequence = 0;  ///< of its last reference that had a place
  std::uint32_t lost = 0;                 ///< States that found no space
  bool canceled = false;                  ///< by another client: what names no epoch does not count
  bool behind = false;         ///< what waits was sent before a cancel or a stop was in force
  int late = 0;                ///< chunks of which nothing was left, since the last one in time
  std::int64_t late_ns = 0;    ///< when the first of them was reported
  const char* slow = nullptr;  ///< what its client has not read, for which it is to be cut
  InputBytes in;
  OutputBytes out;

  bool watches() const { return states.period_ns > 0 || feedback.period_ns > 0 || events; }
  bool there() const { return state == State::kNew || state == State::kOpen; }
  void open(std::uint64_t its_session, std::int64_t now_ns) {
    state = State::kNew;
    session = its_session;
    name = {};
    heard_ns = asked_ns = read_ns = received_ns = now_ns;
    client_ns = 0;
    rate.start(now_ns);
    states = feedback = {};
    events = false;
    epoch = sequence = lost = 0;
    canceled = behind = false;
    late = 0;
    slow = nullptr;
    in.clear();
    out.clear();
  }
};

}  // namespace tactus
