// BoardClient: the computer's end of the link to a board: sends it requests and waits for the
// answer, and takes it through one cycle after the other.
#pragma once

#include "hal/serial/board_frames.hpp"
#include "hal/serial/cycle_frames.hpp"
#include "hal/serial/frame.hpp"
#include "program/pil/emulated_board.hpp"

namespace tactus::pil {

class BoardClient {
 public:
  explicit BoardClient(EmulatedBoard& board) : board_(board) {}

  /// Forgets what was exchanged with a board before. [init]
  void begin();

  /// Sends a message and waits for its answer, which stays until the next request; answer() reads
  /// the data behind the Status. kBusTimeout: none arrived. [any]
  Status request(serial::Kind kind, const ByteWriter& payload);
  Status request(serial::Kind kind);
  ByteReader answer() const {
    return {answer_.data() + 1, answer_size_ > 0 ? answer_size_ - 1 : 0};
  }
  /// [any]
  Status greet(serial::Greeting& greeting);

  /// Hands the board a state and begins a cycle in lock-step; waits for its result. kBusTimeout:
  /// none arrived. [any]
  Status step(serial::Order order, const RobotState& state, std::int64_t stamp_ns);
  /// Lets a board with a timer of its own run to its next exchange, with these bytes for it.
  /// kBusTimeout: it is gone. [any]
  Status turn(const std::uint8_t* bytes, std::size_t size);
  /// Appends a frame with a state to bytes for turn(). [any]
  std::size_t put_state(serial::Order order, const RobotState& state, std::uint8_t* to);

  /// The result of the newest cycle, and their number.
  const serial::CycleResult& result() const { return result_; }
  std::uint32_t results() const { return results_; }
  const serial::LinkHealth& health() const { return reader_.health(); }

 private:
  bool await();
  void take(const serial::Frame& frame);
  bool exchange(const std::uint8_t* bytes, std::size_t size);

  EmulatedBoard& board_;
  serial::FrameReader reader_;
  bool pending_ = false;  // the board waits for our part of an exchange
  std::uint16_t number_ = 0, states_ = 0;
  bool answered_ = false;
  std::array<std::uint8_t, serial::kMaxPayload> answer_;
  std::size_t answer_size_ = 0;
  serial::CycleResult result_;
  std::uint32_t results_ = 0;
};

}  // namespace tactus::pil
