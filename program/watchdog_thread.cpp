#include "program/watchdog_thread.hpp"

#include <cstdio>
#include <cstring>
#include <ctime>

#include "hal/os/ordinary_thread.hpp"

namespace tactus {
namespace {

constexpr timespec kBetweenWatches = {0, 100 * 1000 * 1000};  // a tenth of the shortest timeout

}  // namespace

bool WatchdogThread::start(const RealtimeSettings& settings) {
  if (settings.watchdog.empty()) return true;
  const int error = start_ordinary_thread(thread_, run, this);
  if (error != 0)
    std::fprintf(stderr, "cannot start the watchdog's thread: %s\n", std::strerror(error));
  return started_ = error == 0;
}

bool WatchdogThread::arm(const RealtimeSettings& settings) {
  Message why;
  if (!started_) return true;
  if (!watchdog_.arm(settings.watchdog.c_str(), settings.watchdog_timeout_s, why)) {
    std::fprintf(stderr, "[realtime] watchdog: refused: %s\n", why.c_str());
    return false;
  }
  state_.store(State::kKicking, std::memory_order_release);
  return true;
}

void WatchdogThread::disarm() {
  end();
  Message why;
  if (!watchdog_.disarm(why))
    std::fprintf(stderr, "[realtime] watchdog: %s; the machine will be reset\n", why.c_str());
}

void WatchdogThread::end() {
  if (!started_) return;
  state_.store(State::kEnd, std::memory_order_release);
  pthread_join(thread_, nullptr);
  started_ = false;
}

void* WatchdogThread::run(void* thread) {
  static_cast<WatchdogThread*>(thread)->kick();
  return nullptr;
}

void WatchdogThread::kick() {
  State state = State::kIdle;
  while (state != State::kEnd) {
    state = state_.load(std::memory_order_acquire);
    if (state == State::kKicking) watchdog_.kick();
    nanosleep(&kBetweenWatches, nullptr);
  }
}

}  // namespace tactus
