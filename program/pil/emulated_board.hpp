// EmulatedBoard: a board in an emulator of this computer, at the other end of two pipes. Board and
// computer exchange their bytes once in every period of the board's timer (semihosting_link.hpp).
#pragma once

#include <sys/types.h>

#include <array>

#include "hal/serial/frame.hpp"
#include "kernel/core/text.hpp"

namespace tactus::pil {

/// The program of a board, and the machine on which the emulator runs it.
struct BoardImage {
  Text<1023> path;
  const char* machine;  ///< null: the emulator has none for this core
};

/// The image of a board below the folder `builds`; the board's name ends with its core, as fer_m7,
/// and the name of the image's folder with that and the beginning of `rest`. [init]
BoardImage image_of(std::string_view builds, std::string_view board, std::string_view rest);

class EmulatedBoard {
 public:
  static constexpr std::size_t kMost = 2 * serial::kMaxFrame;  ///< bytes of one exchange

  ~EmulatedBoard() { stop(); }

  /// Starts the emulator with an image. False: `why` names what is missing. [init]
  bool start(const BoardImage& image, Message& why);
  /// Ends it. [any]
  void stop();
  bool running() const { return process_ > 0; }

  /// Waits for the board's part of an exchange; returns its size in `to`, which holds kMost, or -1:
  /// the board is gone, or nothing arrived for 10 s. [any]
  int receive(std::uint8_t* to);
  /// Ends the exchange with at most kMost bytes. False: the board is gone. [any]
  bool send(const std::uint8_t* bytes, std::size_t size);

 private:
  void end_process();
  bool make_pipes(Message& why);
  bool spawn(const BoardImage& image, Message& why);
  bool has_ended();
  bool read_all(std::uint8_t* to, std::size_t size);

  std::array<char, 32> folder_{};
  pid_t process_ = 0;
  int in_ = -1, out_ = -1;
};

}  // namespace tactus::pil
