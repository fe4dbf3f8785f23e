#include "hal/serial/board_link.hpp"

#include <algorithm>

#include "kernel/core/loop_bound.hpp"

namespace tactus::serial {

void BoardLink::poll() {
  std::array<std::uint8_t, kBatch> batch;
  const std::size_t size = bytes_.receive(batch.data(), batch.size());
  LoopBound<kBatch> loop;
  for (std::size_t i = 0; i < size; ++i) {
    loop.tick();
    if (reader_.take(batch[i])) take(reader_.frame());
  }
}

void BoardLink::take(const Frame& frame) {
  ByteReader payload(frame.payload, frame.size);
  if (is_message(frame.kind)) return take_message(frame);
  if (frame.kind == Kind::kTick && frame.size == 8) {
    tick_.stamp_ns = static_cast<std::int64_t>(payload.u64());
    ticked_ = true;
  } else if (frame.kind == Kind::kState && frame.size <= state_.size()) {
    std::copy(frame.payload, frame.payload + frame.size, state_.begin());
    state_size_ = frame.size;
  } else {
    ++refused_;
  }
}

/// A message that was executed is answered again: its answer was lost.
void BoardLink::take_message(const Frame& frame) {
  if (waits_.load(std::memory_order_acquire)) return;
  if (any_executed_ && frame.number == executed_ && frame.kind != Kind::kHello) {
    answered_.store(true, std::memory_order_relaxed);
    return;
  }
  std::copy(frame.payload, frame.payload + frame.size, message_.begin());
  waiting_ = {frame.kind, frame.number, message_.data(), frame.size};
  answered_.store(false, std::memory_order_relaxed);
  waits_.store(true, std::memory_order_release);
}

ByteReader BoardLink::state() {
  const ByteReader payload(state_.data(), state_size_);
  state_size_ = 0;
  return payload;
}

bool BoardLink::tick(CycleTime& now) {
  const bool ticked = ticked_;
  ticked_ = false;
  if (ticked) now = tick_;
  return ticked;
}

void BoardLink::send(const CycleResult& result) {
  std::array<std::uint8_t, 256> payload;
  std::array<std::uint8_t, kMaxFrame> frame;
  ByteWriter writer(payload.data(), payload.size());
  write_result(writer, result);
  const Frame written = {Kind::kCommand, results_++, payload.data(), writer.size()};
  bytes_.send(frame.data(), write_frame(written, frame.data()));
}

void BoardLink::send_answer() {
  if (!answered_.load(std::memory_order_acquire)) return;
  answered_.store(false, std::memory_order_relaxed);
  std::array<std::uint8_t, kMaxFrame> frame;
  const Frame written = {Kind::kAnswer, executed_, answer_.data(), writer_.size()};
  bytes_.send(frame.data(), write_frame(written, frame.data()));
}

bool BoardLink::message(Frame& frame) {
  if (!waits_.load(std::memory_order_acquire)) return false;
  frame = waiting_;
  return true;
}

ByteWriter& BoardLink::answer(Status status) {
  writer_ = ByteWriter(answer_.data(), answer_.size());
  writer_.u8(static_cast<std::uint8_t>(status));
  return writer_;
}

void BoardLink::answered() {
  executed_ = waiting_.number;
  any_executed_ = true;
  answered_.store(true, std::memory_order_release);
  waits_.store(false, std::memory_order_release);
}

}  // namespace tactus::serial
