#include "gateway/ctl/input_devices.hpp"

#include <fcntl.h>
#include <linux/joystick.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>

namespace tactus::ctl {
namespace {

constexpr double kFull = 32767.0;
constexpr double kDeadBand = 0.05;

}  // namespace

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

Joystick::~Joystick() {
  if (file_ >= 0) close(file_);
}

bool Joystick::open(const std::string& path) {
  file_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  return file_ >= 0;
}

bool Joystick::read() {
  js_event event{};
  ssize_t count = 0;
  while ((count = ::read(file_, &event, sizeof event)) == static_cast<ssize_t>(sizeof event)) {
    if ((event.type & ~JS_EVENT_INIT) != JS_EVENT_AXIS) continue;
    if (event.number >= axes_.size()) axes_.resize(event.number + std::size_t{1}, 0.0);
    const double value = event.value / kFull;
    axes_[event.number] = std::abs(value) < kDeadBand ? 0.0 : value;
  }
  return count < 0 && errno == EAGAIN;
}

}  // namespace tactus::ctl
