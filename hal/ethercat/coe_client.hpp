// CoeClient: reads and writes one object of one slave at a time by SDO over CoE: expedited, normal
// and segmented transfers (ETG.1000.6; the bodies are those of CiA 301). Mailbox messages in,
// mailbox messages out; MailboxPort carries them.
#pragma once

#include <algorithm>

#include "hal/can/protocol_canopen.hpp"
#include "hal/can/protocol_sdo.hpp"
#include "hal/ethercat/exchange.hpp"
#include "hal/ethercat/protocol_coe.hpp"
#include "hal/ethercat/protocol_esc.hpp"
#include "hal/ethercat/protocol_frame.hpp"
#include "kernel/core/text.hpp"

namespace tactus::ethercat {

class CoeClient {
 public:
  static constexpr std::size_t kCapacity = 128;  ///< bytes of the longest object
  /// Bytes of a message that are ever written or read, however long the mailbox is: the object
  /// behind command, index, sub-index and size.
  static constexpr std::size_t kMostMessage = kCoeBody + 8 + kCapacity;

  enum class Progress : std::uint8_t { kIdle, kBusy, kDone, kAborted };

  /// Longest time for each answer. [init]
  void set_time(std::int64_t answer_ns) { answer_ns_ = answer_ns; }
  /// Begins to read an object; `out_bytes` is the length of the slave's mailbox. [any]
  void upload(std::size_t out_bytes, std::uint16_t index, std::uint8_t sub, std::int64_t now_ns);
  /// Begins to write the lowest `bytes`, 1 to 4, of `value`. [any]
  void download(std::size_t out_bytes, std::uint16_t index, std::uint8_t sub, std::uint32_t value,
                std::size_t bytes, std::int64_t now_ns);
  /// Begins to write any bytes, at most kCapacity, which are copied. [any]
  void download_bytes(std::size_t out_bytes, std::uint16_t index, std::uint8_t sub,
                      const std::uint8_t* bytes, std::size_t size, std::int64_t now_ns);

  /// Writes the next message into `mailbox`, and zeros behind it up to `size` bytes; those are the
  /// whole mailbox, or kMostMessage. `counter` is that of the last message to this slave, and is
  /// counted on: one with the same is not served again (ETG.1000.4). False: there is none. [any]
  bool take(std::uint8_t* mailbox, std::size_t size, std::uint8_t& counter);
  /// Takes a message of the slave out of a mailbox of `size` bytes, of which kMostMessage are there
  /// at most; what is no answer to the transfer is ignored. Returns true, and the emergency, if it
  /// is one. [any]
  bool receive(const std::uint8_t* mailbox, std::size_t size, can::Emergency& emergency,
               std::int64_t now_ns);
  void advance(std::int64_t now_ns);  ///< ends a transfer that waits too long [any]
  void cancel() { end(Progress::kIdle, can::SdoAbort::kNone); }

  Progress progress() const { return progress_; }
  can::SdoAbort abort() const { return abort_; }
  const std::uint8_t* data() const { return data_.data(); }
  std::size_t size() const { return size_; }
  /// False for an object of up to four bytes whose slave has not indicated the size. [any]
  bool size_known() const { return size_known_; }
  /// The first four bytes as an integer; bytes that the object does not have are 0. [any]
  std::uint32_t value() const { return get<std::uint32_t>(data_.data()); }
  /// "object 6060h:0: value out of range (06090030h)". [any]
  Message describe() const;

 private:
  enum class TransferStep : std::uint8_t { kNone, kRead, kReadSegment, kWrite, kWriteSegment };

  void begin(TransferStep step, std::size_t out_bytes, std::uint16_t index, std::uint8_t sub,
             std::int64_t now_ns);
  void end(Progress progress, can::SdoAbort abort);
  void ignore(const char* why);
  void fail(can::SdoAbort abort) { end(Progress::kAborted, abort); }
  std::size_t write_body(std::uint8_t* body);
  void take_answer(const std::uint8_t* body, std::size_t size);
  void take_upload(const std::uint8_t* body, std::size_t size);
  void take_segment(const std::uint8_t* body, std::size_t size);

  Progress progress_ = Progress::kIdle;
  TransferStep step_ = TransferStep::kNone;
  can::SdoAbort abort_ = can::SdoAbort::kNone;
  std::int64_t answer_ns_ = 500'000'000, heard_ns_ = 0;
  bool to_send_ = false, toggle_ = false, silent_ = false, too_large_ = false;
  bool size_known_ = false;
  int wrong_ = 0;               // messages that are no answer to the transfer
  const char* wrong_why_ = "";  // the last of them
  std::uint8_t sub_ = 0;
  std::uint16_t index_ = 0;
  std::uint16_t refused_ = 0;        // detail of the slave's mailbox error; 0: there was none
  std::size_t room_ = 0;             // bytes of a body in the slave's mailbox
  std::size_t size_ = 0, done_ = 0;  // of the object, and transferred
  std::array<std::uint8_t, kCapacity> data_{};
};

/// The mailboxes of a slave.
struct Mailboxes {
  static constexpr std::size_t kLeast = kCoeBody + 8;  ///< bytes, for an SDO message
  static constexpr std::size_t kMost = kMaxData;

  std::uint16_t station = 0;
  std::uint16_t out = 0, out_bytes = 0, in = 0, in_bytes = 0;
  std::uint8_t counter = 0;  ///< of the last message to the slave, 1 to 7; 0: there was none
};

/// Carries the messages of a CoeClient to and from the mailboxes of slaves, one datagram at a time:
/// writes a request, polls for an answer, reads it.
///
/// A mailbox is accessed as a whole, as its sync manager becomes full or empty with its last byte.
/// Where the frame has no room for that, it is accessed in several datagrams, from its first byte
/// on, as a slave controller allows it (ESC data sheet, section I, sync managers). A message is
/// never longer than the first of them.
class MailboxPort {
 public:
  static_assert(CoeClient::kMostMessage <= Request::kKept);

  explicit MailboxPort(CoeClient& client) : client_(client) {}

  void reset() {
    access_ = Access::kIdle;
    done_ = 0;
  }
  /// Returns the next datagram to the slave, with at most `room` bytes of data, which are
  /// Request::kKept or more. [any]
  Request next(Mailboxes& boxes, std::size_t room) {
    if (done_ == 0) {
      Request write(Command::kFpwr, address_of(boxes.station, boxes.out),
                    std::min<std::size_t>(boxes.out_bytes, room));
      if (client_.take(write.data.data(), write.kept(), boxes.counter)) {
        access_ = Access::kWrite;
        asked_ = write.size;
        return write;
      }
    }
    const std::uint16_t station = boxes.station;
    if (access_ == Access::kWrite)
      return part(Command::kFpwr, station, boxes.out, boxes.out_bytes, room);
    if (access_ == Access::kRead)
      return part(Command::kFprd, station, boxes.in, boxes.in_bytes, room);
    access_ = Access::kPoll;
    constexpr auto kStatus = static_cast<std::uint16_t>(kSmReg + kSmBytes + 5);
    return Request(Command::kFprd, address_of(station, kStatus), 1);
  }
  /// Takes the answer to next(), none if `answer.data` is null. Returns true, and the emergency, if
  /// the slave has sent one. [any]
  bool take(const Mailboxes& boxes, const Answer& answer, can::Emergency& emergency,
            std::int64_t now_ns) {
    const bool good = answer.data != nullptr && answer.counter == 1;
    const Access access = access_;
    const std::size_t before = done_;
    reset();
    if (!good) return false;
    if (access == Access::kPoll && (answer.data[0] & kSmFull) != 0) access_ = Access::kRead;
    if (access != Access::kWrite && access != Access::kRead) return false;
    if (access == Access::kRead && before == 0)
      std::memcpy(message_.data(), answer.data, std::min(asked_, message_.size()));
    const std::size_t bytes = access == Access::kRead ? boxes.in_bytes : boxes.out_bytes;
    if (before + asked_ < bytes) {
      access_ = access;
      done_ = before + asked_;
      return false;
    }
    return access == Access::kRead &&
           client_.receive(message_.data(), boxes.in_bytes, emergency, now_ns);
  }
  /// True if the slave has a message that next() is going to read, or a mailbox is accessed in
  /// part. [any]
  bool busy() const { return access_ == Access::kRead || done_ > 0; }

 private:
  enum class Access : std::uint8_t { kIdle, kWrite, kPoll, kRead };

  /// The rest of a mailbox.
  Request part(Command command, std::uint16_t station, std::uint16_t start, std::size_t bytes,
               std::size_t room) {
    asked_ = std::min(bytes - done_, room);
    return Request(command, address_of(station, static_cast<std::uint16_t>(start + done_)), asked_);
  }

  CoeClient& client_;
  Access access_ = Access::kIdle;
  std::size_t asked_ = 0, done_ = 0;  // bytes of the mailbox: of the last datagram, and before it
  std::array<std::uint8_t, CoeClient::kMostMessage> message_{};  // that is being read
};

}  // namespace tactus::ethercat
