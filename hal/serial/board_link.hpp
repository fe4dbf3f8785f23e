// BoardLink: the board's end of the link. The cycle receives and sends; messages pass to the
// background and their answers back, one at a time.
#pragma once

#include <atomic>

#include "hal/serial/cycle_frames.hpp"
#include "hal/serial/frame.hpp"
#include "kernel/core/clock.hpp"

namespace tactus::serial {

/// Byte transport: a serial port with its buffers, or a substitute.
class ByteLink {
 public:
  /// Takes up to `capacity` bytes that have arrived; never waits for more. [cyclic]
  virtual std::size_t receive(std::uint8_t* to, std::size_t capacity) = 0;
  /// Sends all of them, or keeps them to be sent. [cyclic]
  virtual void send(const std::uint8_t* bytes, std::size_t size) = 0;

 protected:
  ~ByteLink() = default;
};

class BoardLink {
 public:
  /// `bytes` outlives the link. [init]
  explicit BoardLink(ByteLink& bytes) : bytes_(bytes) {}

  /// Takes what has arrived. kState goes to `state`, of which the newest counts. A message waits
  /// for the background; one that arrives before the last is answered is dropped, and is repeated.
  /// [cyclic]
  void poll();
  /// The payload of the newest kState since the last call; empty: none arrived. [cyclic]
  ByteReader state();
  /// True once for every kTick received; `now` is its stamp. [cyclic]
  bool tick(CycleTime& now);
  /// Discards states and ticks that have arrived. [cyclic]
  void forget() {
    state_size_ = 0;
    ticked_ = false;
  }
  /// Sends the result of a cycle, and an answer of the background. [cyclic]
  void send(const CycleResult& result);
  void send_answer();

  /// The next message to execute; false: none. It must be answered. [background]
  bool message(Frame& frame);
  /// Answers the message: fill in after the status, then call answered(). [background]
  ByteWriter& answer(Status status);
  void answered();

  const LinkHealth& health() const { return reader_.health(); }
  std::uint32_t refused() const { return refused_; }  ///< frames of unknown kind or size

 private:
  static constexpr std::size_t kBatch = 2 * kMaxFrame;  // most bytes of one cycle
  static constexpr std::size_t kMaxState = 512;

  void take(const Frame& frame);
  void take_message(const Frame& frame);

  ByteLink& bytes_;
  FrameReader reader_;
  std::array<std::uint8_t, kMaxState> state_;
  std::size_t state_size_ = 0;
  CycleTime tick_;
  bool ticked_ = false;
  std::uint16_t results_ = 0;
  std::uint32_t refused_ = 0;

  // Message to the background, which clears `waits_`; its answer, for which the cycle clears
  // `answered_`.
  std::array<std::uint8_t, kMaxPayload> message_, answer_;
  Frame waiting_;
  std::atomic<bool> waits_{false}, answered_{false};
  ByteWriter writer_{answer_.data(), answer_.size()};
  std::uint16_t executed_ = 0;  // number of the last message, whose answer is kept
  bool any_executed_ = false;
};

}  // namespace tactus::serial
