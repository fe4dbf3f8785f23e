#include "gateway/ctl/raw_terminal.hpp"

#include <poll.h>
#include <unistd.h>

namespace tactus::ctl {

RawTerminal::RawTerminal()
    : terminal_(isatty(STDIN_FILENO) != 0 && tcgetattr(STDIN_FILENO, &before_) == 0) {
  if (!terminal_) return;
  termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  tcsetattr(STDIN_FILENO, TCSANOW, &raw);
}

RawTerminal::~RawTerminal() {
  if (terminal_) tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

bool take_keys(std::string& keys) {
  keys.clear();
  pollfd ready = {STDIN_FILENO, POLLIN, 0};
  if (poll(&ready, 1, 0) <= 0) return true;
  char bytes[64];
  const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
  if (count > 0) keys.assign(bytes, static_cast<std::size_t>(count));
  return count != 0;
}

}  // namespace tactus::ctl
