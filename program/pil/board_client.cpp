#include "program/pil/board_client.hpp"

#include <cstring>

namespace tactus::pil {

using serial::Frame;
using serial::Kind;

namespace {

constexpr int kRepeat = 64;       // exchanges after which a message is sent again
constexpr int kLongest = 20'000;  // exchanges for one message
constexpr int kLongestCycle = 8;  // exchanges until the result of a cycle

}  // namespace

void BoardClient::begin() {
  reader_ = serial::FrameReader();
  pending_ = false;
  result_ = serial::CycleResult();
  results_ = 0;
}

void BoardClient::take(const Frame& frame) {
  if (frame.kind == Kind::kCommand) {
    ByteReader payload(frame.payload, frame.size);
    if (serial::read_result(payload, result_)) ++results_;
  } else if (frame.kind == Kind::kAnswer && frame.number == number_ && frame.size > 0) {
    std::memcpy(answer_.data(), frame.payload, frame.size);
    answer_size_ = frame.size;
    answered_ = true;
  }
}

/// Waits for the board's part of an exchange, and takes its frames.
bool BoardClient::await() {
  if (pending_) return true;
  static std::uint8_t bytes[EmulatedBoard::kMost];
  const int size = board_.receive(bytes);
  for (int i = 0; i < size; ++i)
    if (reader_.take(bytes[i])) take(reader_.frame());
  pending_ = size >= 0;
  return pending_;
}

/// Ends the present exchange, and waits for the board's part of the next.
bool BoardClient::exchange(const std::uint8_t* bytes, std::size_t size) {
  if (!await() || !board_.send(bytes, size)) return false;
  pending_ = false;
  return await();
}

Status BoardClient::turn(const std::uint8_t* bytes, std::size_t size) {
  return exchange(bytes, size) ? Status::kOk : Status::kBusTimeout;
}

Status BoardClient::request(Kind kind) {
  std::uint8_t nothing[1];
  return request(kind, ByteWriter(nothing, 0));
}

Status BoardClient::request(Kind kind, const ByteWriter& payload) {
  std::uint8_t bytes[serial::kMaxFrame];
  ++number_;
  const std::size_t size =
      serial::write_frame({kind, number_, payload.data(), payload.size()}, bytes);
  answered_ = false;
  for (int i = 0; i < kLongest; ++i) {
    if (!exchange(bytes, i % kRepeat == 0 ? size : 0)) break;
    if (answered_) return static_cast<Status>(answer_[0]);
  }
  return Status::kBusTimeout;
}

Status BoardClient::greet(serial::Greeting& greeting) {
  TRY(request(Kind::kHello));
  ByteReader from = answer();
  return read(from, greeting) ? Status::kOk : Status::kWireFormat;
}

std::size_t BoardClient::put_state(serial::Order order, const RobotState& state, std::uint8_t* to) {
  std::uint8_t payload[512];
  ByteWriter writer(payload, sizeof payload);
  write_state(writer, order, state);
  return serial::write_frame({Kind::kState, states_++, payload, writer.size()}, to);
}

Status BoardClient::step(serial::Order order, const RobotState& state, std::int64_t stamp_ns) {
  std::uint8_t bytes[2 * serial::kMaxFrame], stamp[8];
  ByteWriter writer(stamp, sizeof stamp);
  writer.u64(static_cast<std::uint64_t>(stamp_ns));
  std::size_t size = put_state(order, state, bytes);
  size += serial::write_frame({Kind::kTick, states_, stamp, writer.size()}, bytes + size);
  const std::uint32_t before = results_;
  for (int i = 0; i < kLongestCycle; ++i) {
    TRY(turn(bytes, i == 0 ? size : 0));
    if (results_ != before) return Status::kOk;
  }
  return Status::kBusTimeout;
}

}  // namespace tactus::pil
