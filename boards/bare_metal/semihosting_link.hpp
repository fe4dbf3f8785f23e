// SemihostingLink: the link of an emulated board, over two named pipes of the machine that emulates
// it. In every cycle both ends exchange what they have to say, however little:
//
//   size u16, bytes
//
// The exchange stops the board's time, so a computer that is slow does not make it late.
#pragma once

#include "hal/serial/board_link.hpp"

namespace bare {

class SemihostingLink final : public tactus::serial::ByteLink {
 public:
  /// Opens to_board and from_board in the folder that is the last word of the emulator's command
  /// line. False: they are not there. [init]
  bool open();

  /// Sends what was given to send() and takes what the computer sends back. [cyclic]
  std::size_t receive(std::uint8_t* to, std::size_t capacity) override;
  void send(const std::uint8_t* bytes, std::size_t size) override;

 private:
  static constexpr std::size_t kHead = 2, kMost = 2 * tactus::serial::kMaxFrame;

  void read(std::uint8_t* to, std::size_t size);

  int in_ = -1, out_ = -1;
  std::array<std::uint8_t, kHead + kMost> waiting_;  // to be sent, behind its size
  std::size_t size_ = 0;
};

}  // namespace bare
