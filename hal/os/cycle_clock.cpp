#include "hal/os/cycle_clock.hpp"

#include <cerrno>
#include <ctime>

#include "kernel/core/nanoseconds.hpp"

namespace tactus {

std::int64_t monotonic_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

Status CycleClock::start(std::int64_t period_ns) {
  if (period_ns <= 0) return Status::kBadValue;
  period_ns_ = period_ns;
  planned_ns_ = monotonic_ns();
  return Status::kOk;
}

Status CycleClock::wait(Wake& wake) {
  if (period_ns_ == 0) return Status::kNotStarted;
  wake.planned_ns = next_wake_ns(planned_ns_, monotonic_ns(), period_ns_);
  wake.missed = (wake.planned_ns - planned_ns_) / period_ns_ - 1;
  planned_ns_ = wake.planned_ns;
  const timespec until = {wake.planned_ns / kSecond_ns, wake.planned_ns % kSecond_ns};
  int error = EINTR;  // the time is absolute, so the same sleep continues after a signal
  while (error == EINTR) {
    error = clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  }
  wake.stamp_ns = monotonic_ns();
  return error == 0 ? Status::kOk : Status::kClock;
}

}  // namespace tactus
