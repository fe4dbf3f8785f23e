// EthercatHal: the clock of its cycles, and how it leaves the drives.
#include <cerrno>
#include <ctime>

#include "hal/ethercat/ethercat_hal.hpp"
#include "hal/net/deadline.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ethercat {
namespace {

constexpr int kMostWaits = 100;  // for the frame of a cycle, as others may come

}  // namespace

/// A period after the last cycle, and what the reference clock asks for. Periods that were missed
/// are left out.
Status EthercatHal::wait(CycleTime& now) {
  const std::int64_t period_ns = std::int64_t{1000} * master_.period_us();
  const std::int64_t before_ns = Deadline::now_ns();
  if (planned_ns_ < 0) planned_ns_ = began_ns_ + master_.in_step(before_ns - began_ns_);
  planned_ns_ += period_ns + master_.steer().correction();
  if (planned_ns_ < before_ns)
    planned_ns_ += ((before_ns - planned_ns_) / period_ns + 1) * period_ns;
  const timespec until = {planned_ns_ / kSecond_ns, planned_ns_ % kSecond_ns};
  int result = EINTR;
  while (result == EINTR) result = clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  if (result != 0) return Status::kClock;
  now.stamp_ns = Deadline::now_ns();
  if (ethercat_->frame_wait_ms == 0) return Status::kOk;
  // A wire that does not answer is not waited for: the drives are given up by the clock.
  const Deadline deadline(ethercat_->frame_wait_ms);
  LoopBound<kMostWaits> waits;
  for (int i = 0; i < kMostWaits && master_.awaits() && master_.answers(); ++i) {
    waits.tick();
    if (deadline.left_ns() <= 0 || !socket_.wait(deadline.left_ns())) break;
    receive();
  }
  if (now_ns_ >= 0) now.stamp_ns = now_ns_ + period_ns;
  return Status::kOk;
}

/// Goes on with the exchange until every drive has confirmed that it is disabled; one that is
/// silent may be heard again.
Status EthercatHal::stop_drives(Message& left) {
  const std::int64_t began_ns = Deadline::now_ns();
  const auto waited_ns = [&] { return Deadline::now_ns() - began_ns; };
  const auto awaited = [this](int joint) { return !master_.confirmed(joint) && !socket_.lost(); };
  const std::int64_t longest_ns =
      cia402::longest_leaving_ns(master_.stop_ms(), master_.period_us());
  CycleTime now;
  while (cia402::any_joint(awaited) && waited_ns() < longest_ns && wait(now) == Status::kOk)
    cia402::exchange_stop(*this, now, mode_);
  return cia402::judge_stop(master_, waited_ns(), left);
}

Status EthercatHal::disconnect() {
  Status status = Status::kOk;
  Message left;
  if (master_.connected() && now_ns_ >= 0) status = stop_drives(left);
  master_.leave();
  send();
  if (status != Status::kOk) master_.why() = left;
  socket_.close();
  fault_ = Status::kNotStarted;
  now_ns_ = planned_ns_ = -1;
  return status;
}

}  // namespace tactus::ethercat
