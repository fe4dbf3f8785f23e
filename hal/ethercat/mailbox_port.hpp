// MailboxPort: carries the messages of a CoeClient to and from the mailboxes of slaves, one
// datagram at a time: writes a request, asks whether an answer is there, reads it.
#pragma once

#include "hal/ethercat/coe_client.hpp"
#include "hal/ethercat/exchange.hpp"
#include "hal/ethercat/protocol_esc.hpp"

namespace tactus::ethercat {

/// The mailboxes of a slave.
struct Mailboxes {
  std::uint16_t station = 0;
  std::uint16_t out = 0, out_bytes = 0, in = 0, in_bytes = 0;
};

class MailboxPort {
 public:
  explicit MailboxPort(CoeClient& client) : client_(client) {}

  void reset() { phase_ = Phase::kIdle; }
  /// Returns the next datagram to the slave. [any]
  Request next(const Mailboxes& boxes) {
    const std::uint32_t out = address_of(boxes.station, boxes.out);
    Request write(Command::kFpwr, out, boxes.out_bytes);
    if (client_.take(write.data.data(), write.size)) {
      phase_ = Phase::kWrites;
      return write;
    }
    if (phase_ == Phase::kFull)
      return Request(Command::kFprd, address_of(boxes.station, boxes.in), boxes.in_bytes);
    phase_ = Phase::kAsks;
    constexpr auto kStatus = static_cast<std::uint16_t>(kSmReg + kSmBytes + 5);
    return Request(Command::kFprd, address_of(boxes.station, kStatus), 1);
  }
  /// Takes the answer to next(), none if `answer.data` is null. Returns true, and the emergency, if
  /// the slave has sent one. [any]
  bool take(const Mailboxes& boxes, const Answer& answer, can::Emergency& emergency,
            std::int64_t now_ns) {
    const bool good = answer.data != nullptr && answer.counter == 1;
    const Phase phase = phase_;
    phase_ = Phase::kIdle;
    if (phase == Phase::kAsks && good && (answer.data[0] & kSmFull) != 0) phase_ = Phase::kFull;
    return phase == Phase::kFull && good &&
           client_.receive(answer.data, boxes.in_bytes, emergency, now_ns);
  }
  /// True if the slave has a message that next() is going to read. [any]
  bool full() const { return phase_ == Phase::kFull; }

 private:
  enum class Phase : std::uint8_t { kIdle, kWrites, kAsks, kFull };

  CoeClient& client_;
  Phase phase_ = Phase::kIdle;
};

}  // namespace tactus::ethercat
