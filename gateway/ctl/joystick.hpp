// Joystick: the axes of a device of Linux's joystick interface (Documentation/input/joydev).
#pragma once

#include <string>
#include <vector>

namespace tactus::ctl {

class Joystick {
 public:
  Joystick() = default;
  ~Joystick();
  Joystick(const Joystick&) = delete;
  Joystick& operator=(const Joystick&) = delete;

  /// Opens a device. False: errno says why.
  bool open(const std::string& path);
  /// Takes all events that have come. False: the device is gone.
  bool read();

  int descriptor() const { return file_; }
  /// Deflection of each axis that has moved so far, -1 to 1; 0 within the dead band of 5 %.
  const std::vector<double>& axes() const { return axes_; }

 private:
  int file_ = -1;
  std::vector<double> axes_;
};

}  // namespace tactus::ctl
