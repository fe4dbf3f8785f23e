// Input devices with which an operator moves the arm: the keys of the terminal, and a joystick.
#pragma once

#include <string>
#include <vector>

#include <termios.h>

namespace tactus::ctl {

/// Single keys from the terminal at standard input, without echo, while the object exists. Where
/// standard input is no terminal, it is left as it is.
class RawTerminal {
 public:
  RawTerminal();
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  bool terminal() const { return terminal_; }

 private:
  termios before_{};
  bool terminal_;
};

/// Takes the keys that have arrived, without waiting. False: the input has ended.
bool take_keys(std::string& keys);

/// The axes of a device of Linux's joystick interface (Documentation/input/joydev).
class Joystick {
 public:
  Joystick() = default;
  ~Joystick();
  Joystick(const Joystick&) = delete;
  Joystick& operator=(const Joystick&) = delete;

  /// Opens a device. False: see errno.
  bool open(const std::string& path);
  /// Takes all events that have arrived. False: the device is gone.
  bool read();

  int descriptor() const { return file_; }
  /// Deflection of each axis that has moved so far, -1 to 1; 0 within the dead band of 5 %.
  const std::vector<double>& axes() const { return axes_; }

 private:
  int file_ = -1;
  std::vector<double> axes_;
};

}  // namespace tactus::ctl
