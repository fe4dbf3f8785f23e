#include "hal/os/watchdog.hpp"

#include <fcntl.h>
#include <linux/watchdog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tactus {
namespace {

constexpr char kKick = '\0', kMagicClose = 'V';

}  // namespace

/// Sets the timeout; returns why the driver refuses, empty if it does not. A file that is no
/// watchdog is closed, and nothing is written to it. A driver without magic close stops its timer
/// when a program crashes.
Message Watchdog::refusal(int timeout_s) {
  watchdog_info info{};
  int granted_s = timeout_s;
  Message why;
  if (driver_(file_, WDIOC_GETSUPPORT, &info) != 0) {
    why << "is no watchdog: " << std::strerror(errno);
    close_device();
    return why;
  }
  if ((info.options & WDIOF_MAGICCLOSE) == 0)
    why << "has no magic close: a crash would stop it; load another driver";
  else if (driver_(file_, WDIOC_SETTIMEOUT, &granted_s) != 0)
    why << "does not take watchdog_timeout_s = " << timeout_s << ": " << std::strerror(errno)
        << "; choose one that the driver offers";
  else if (granted_s != timeout_s)
    why << "makes " << granted_s << " of watchdog_timeout_s = " << timeout_s << "; write that";
  return why;
}

bool Watchdog::arm(const char* device, int timeout_s, Message& why) {
  Message reason, ignored;
  file_ = open(device, O_WRONLY | O_CLOEXEC);
  if (file_ < 0) {
    reason << "cannot be opened: " << std::strerror(errno);
    if (errno == EBUSY) reason << "; end the program that has it (RuntimeWatchdogSec of systemd?)";
  } else {
    reason = refusal(timeout_s);
  }
  if (reason.empty()) return true;
  why = Message(device) << " " << reason;
  disarm(ignored);
  return false;
}

void Watchdog::kick() {
  const std::uint64_t completed = completed_.load(std::memory_order_acquire);
  if (!armed() || completed == kicked_) return;
  if (write(file_, &kKick, 1) == 1) kicked_ = completed;
}

bool Watchdog::disarm(Message& why) {
  if (!armed()) return true;
  const bool stopped = write(file_, &kMagicClose, 1) == 1;
  if (!stopped) why = Message("cannot be stopped: ") << std::strerror(errno);
  close_device();
  return stopped;
}

void Watchdog::close_device() {
  if (file_ >= 0) close(file_);
  file_ = -1;
}

}  // namespace tactus
