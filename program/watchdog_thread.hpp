// WatchdogThread: a thread without priority that restarts the machine's watchdog as long as cycles
// complete, so that no cycle waits for the device.
#pragma once

#include <pthread.h>

#include "hal/os/realtime_settings.hpp"
#include "hal/os/watchdog.hpp"

namespace tactus {

class WatchdogThread {
 public:
  explicit WatchdogThread(Ioctl driver = system_ioctl) : watchdog_(driver) {}
  ~WatchdogThread() { end(); }
  WatchdogThread(const WatchdogThread&) = delete;
  WatchdogThread& operator=(const WatchdogThread&) = delete;

  /// Starts the thread, which waits for arm(), if the settings name a watchdog. Call it before the
  /// calling thread is bound to a CPU. False: prints the reason to stderr. [init]
  bool start(const RealtimeSettings& settings);
  /// Starts the watchdog, if there is one, just before the first cycle. False: prints the reason to
  /// stderr. [init]
  bool arm(const RealtimeSettings& settings);
  /// Counts a cycle. [cyclic]
  void cycle_completed() { watchdog_.cycle_completed(); }
  /// Ends the thread and stops the watchdog; for an arm that was stopped as it should. [init]
  void disarm();

 private:
  enum class State { kIdle, kKicking, kEnd };
  static void* run(void* thread);
  void kick();
  void end();

  Watchdog watchdog_;
  std::atomic<State> state_{State::kIdle};
  pthread_t thread_{};
  bool started_ = false;
};

}  // namespace tactus
