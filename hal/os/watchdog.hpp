// Watchdog: a hardware timer behind Linux's watchdog interface that resets the machine unless it is
// restarted in time. Only completed cycles restart it. The cycle's thread counts them, another
// thread writes to the device, which may take long.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/os/ioctl.hpp"
#include "kernel/core/load_error.hpp"

namespace tactus {

class Watchdog {
 public:
  explicit Watchdog(Ioctl driver = system_ioctl) : driver_(driver) {}
  /// Leaves a timer that was not disarmed running.
  ~Watchdog() { close_device(); }
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// Opens the device, which starts its timer, and sets the time after which it resets the machine.
  /// False: `why` names what failed, and the timer does not run. [init]
  bool arm(const char* device, int timeout_s, Message& why);
  /// Counts a completed cycle. [cyclic]
  void cycle_completed() { completed_.fetch_add(1, std::memory_order_release); }
  /// Restarts the timer if a cycle has completed since the last call. [any, one thread, not the
  /// cycle's: the device may block]
  void kick();
  /// Stops the timer by the magic close. False: it cannot be stopped, and `why` has the reason.
  /// [init]
  bool disarm(Message& why);
  bool armed() const { return file_ >= 0; }

 private:
  Message refusal(int timeout_s);
  void close_device();

  Ioctl driver_;
  int file_ = -1;
  std::atomic<std::uint64_t> completed_{0};
  std::uint64_t kicked_ = 0;  // completed cycles at the last restart
};

}  // namespace tactus
