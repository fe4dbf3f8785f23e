// Exchange: one datagram at a time to the segment and its answer, for the start-up and for scans:
// sent again if it is lost. It neither sends nor waits: the caller carries frames and passes the
// time.
#pragma once

#include "hal/ethercat/protocol_frame.hpp"

namespace tactus::ethercat {

/// A datagram to send. Only the first bytes of its data can be other than zero; of the answer only
/// these are kept. So a mailbox of any length costs no memory but that of a frame.
struct Request {
  static constexpr std::size_t kKept = 144;  ///< the longest message that CoeClient takes or sends

  Command command = Command::kNop;
  std::uint32_t address = 0;
  std::size_t size = 0;  ///< of the data, at most kMaxData
  std::array<std::uint8_t, kKept> data{};

  Request() = default;
  /// `bytes` bytes, at most kMaxData, of zeros: what a read sends. [any]
  Request(Command to_do, std::uint32_t where, std::size_t bytes)
      : command(to_do), address(where), size(bytes < kMaxData ? bytes : kMaxData) {}
  /// The bytes that are kept. [any]
  std::size_t kept() const { return size < kKept ? size : kKept; }
  /// Appends the datagram; false: the frame has no room for it. [any]
  bool add_to(FrameWriter& writer, std::uint8_t index) const {
    std::uint8_t* const to = writer.add(command, index, address, size);
    if (to != nullptr) std::memcpy(to, data.data(), kept());
    return to != nullptr;
  }
  template <class Number>
  static Request number(Command command, std::uint32_t address, Number value) {
    Request request(command, address, sizeof value);
    put(request.data.data(), value);
    return request;
  }
};

/// The answer to it, of which Request::kKept bytes are kept.
struct Answer {
  int counter = 0;
  const std::uint8_t* data = nullptr;

  std::uint16_t word(std::size_t at = 0) const { return get<std::uint16_t>(data + at); }
};

class Exchange {
 public:
  static constexpr int kAttempts = 5;
  static constexpr std::int64_t kAnswer_ns = 20'000'000;  ///< for each attempt

  enum class Progress : std::uint8_t { kIdle, kBusy, kDone, kLost };

  /// The sender's Ethernet address, 6 bytes. [init]
  void set_source(const std::uint8_t* source) { std::memcpy(source_, source, sizeof source_); }
  void ask(const Request& request, std::int64_t now_ns);
  /// Copies the frame to send; false: there is none. [any]
  bool take(Frame& frame);
  /// Takes any frame; one that is not the answer is ignored. [any]
  void receive(Frame& frame);
  void advance(std::int64_t now_ns);  ///< [any]

  Progress progress() const { return progress_; }
  /// After kDone, until the next ask(). [any]
  Answer answer() const { return {counter_, data_.data()}; }
  const std::uint8_t* source() const { return source_; }

 private:
  std::uint8_t source_[6] = {0x02, 0, 0, 0, 0, 0x01};
  Progress progress_ = Progress::kIdle;
  Request request_;
  std::uint8_t index_ = 0;
  bool to_send_ = false;
  int attempts_ = 0;
  std::int64_t sent_ns_ = 0;
  int counter_ = 0;
  std::array<std::uint8_t, Request::kKept> data_{};
};

}  // namespace tactus::ethercat
