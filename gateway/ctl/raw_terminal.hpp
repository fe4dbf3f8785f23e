// RawTerminal: single keys from the terminal at standard input, without echo, until it goes out of
// scope. Where standard input is no terminal, it is left as it is.
#pragma once

#include <string>

#include <termios.h>

namespace tactus::ctl {

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

/// Takes the keys that have come, without waiting. False: the input has ended.
bool take_keys(std::string& keys);

}  // namespace tactus::ctl
