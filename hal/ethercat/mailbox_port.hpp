// MailboxPort: carries the messages of a CoeClient to and from the mailboxes of slaves, one
// datagram at a time: writes a request, asks whether an answer is there, reads it.
//
// A mailbox is accessed as a whole, as its sync manager becomes full or empty with its last byte.
// Where the frame has no room for that, it is accessed in several datagrams, from its first byte
// on, as a slave controller allows it (ESC data sheet, section I, sync managers). A message is
// never longer than the first of them.
#pragma once

#include <algorithm>

#include "hal/ethercat/coe_client.hpp"
#include "hal/ethercat/exchange.hpp"
#include "hal/ethercat/protocol_esc.hpp"

namespace tactus::ethercat {

/// The mailboxes of a slave.
struct Mailboxes {
  static constexpr std::size_t kLeast = kCoeBody + 8;  ///< bytes, for an SDO message
  static constexpr std::size_t kMost = kMaxData;

  std::uint16_t station = 0;
  std::uint16_t out = 0, out_bytes = 0, in = 0, in_bytes = 0;
  std::uint8_t counter = 0;  ///< of the last message to the slave, 1 to 7; 0: there was none
};

class MailboxPort {
 public:
  static_assert(CoeClient::kMostMessage <= Request::kKept);

  explicit MailboxPort(CoeClient& client) : client_(client) {}

  void reset() {
    phase_ = Phase::kIdle;
    done_ = 0;
  }
  /// Returns the next datagram to the slave, with at most `room` bytes of data, which are
  /// Request::kKept or more. [any]
  Request next(Mailboxes& boxes, std::size_t room) {
    if (done_ == 0) {
      Request write(Command::kFpwr, address_of(boxes.station, boxes.out),
                    std::min<std::size_t>(boxes.out_bytes, room));
      if (client_.take(write.data.data(), write.kept(), boxes.counter)) {
        phase_ = Phase::kWrites;
        asked_ = write.size;
        return write;
      }
    }
    const std::uint16_t station = boxes.station;
    if (phase_ == Phase::kWrites)
      return part(Command::kFpwr, station, boxes.out, boxes.out_bytes, room);
    if (phase_ == Phase::kFull)
      return part(Command::kFprd, station, boxes.in, boxes.in_bytes, room);
    phase_ = Phase::kAsks;
    constexpr auto kStatus = static_cast<std::uint16_t>(kSmReg + kSmBytes + 5);
    return Request(Command::kFprd, address_of(station, kStatus), 1);
  }
  /// Takes the answer to next(), none if `answer.data` is null. Returns true, and the emergency, if
  /// the slave has sent one. [any]
  bool take(const Mailboxes& boxes, const Answer& answer, can::Emergency& emergency,
            std::int64_t now_ns) {
    const bool good = answer.data != nullptr && answer.counter == 1;
    const Phase phase = phase_;
    const std::size_t before = done_;
    reset();
    if (!good) return false;
    if (phase == Phase::kAsks && (answer.data[0] & kSmFull) != 0) phase_ = Phase::kFull;
    if (phase != Phase::kWrites && phase != Phase::kFull) return false;
    if (phase == Phase::kFull && before == 0)
      std::memcpy(message_.data(), answer.data, std::min(asked_, message_.size()));
    const std::size_t bytes = phase == Phase::kFull ? boxes.in_bytes : boxes.out_bytes;
    if (before + asked_ < bytes) {
      phase_ = phase;
      done_ = before + asked_;
      return false;
    }
    return phase == Phase::kFull &&
           client_.receive(message_.data(), boxes.in_bytes, emergency, now_ns);
  }
  /// True if the slave has a message that next() is going to read, or a mailbox is accessed in
  /// part. [any]
  bool busy() const { return phase_ == Phase::kFull || done_ > 0; }

 private:
  enum class Phase : std::uint8_t { kIdle, kWrites, kAsks, kFull };

  /// What is left of a mailbox.
  Request part(Command command, std::uint16_t station, std::uint16_t start, std::size_t bytes,
               std::size_t room) {
    asked_ = std::min(bytes - done_, room);
    return Request(command, address_of(station, static_cast<std::uint16_t>(start + done_)), asked_);
  }

  CoeClient& client_;
  Phase phase_ = Phase::kIdle;
  std::size_t asked_ = 0, done_ = 0;  // bytes of the mailbox: of the last datagram, and before it
  std::array<std::uint8_t, CoeClient::kMostMessage> message_{};  // that is being read
};

}  // namespace tactus::ethercat
