// EthercatHal: the clock of its cycles, and how it leaves the drives.
#include <cerrno>
#include <ctime>

#include "hal/ethercat/ethercat_hal.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kLater = 20;  // cycles beyond the longest quick stop

std::int64_t clock_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

}  // namespace

/// A period after the last cycle, and what the reference clock asks for. Periods that were missed
/// are left out.
Status EthercatHal::wait(CycleTime& now) {
  const std::int64_t period_ns = std::int64_t{1000} * master_.period_us();
  const std::int64_t before_ns = clock_ns();
  if (planned_ns_ < 0) planned_ns_ = before_ns;
  planned_ns_ += period_ns + master_.steer().correction();
  if (planned_ns_ < before_ns)
    planned_ns_ += ((before_ns - planned_ns_) / period_ns + 1) * period_ns;
  const timespec until = {planned_ns_ / kSecond_ns, planned_ns_ % kSecond_ns};
  int result = EINTR;
  while (result == EINTR) result = clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
  if (result != 0) return Status::kClock;
  now.stamp_ns = clock_ns();
  if (ethercat_->frame_wait_ms == 0) return Status::kOk;
  if (master_.awaits()) (void)socket_.wait(std::int64_t{1'000'000} * ethercat_->frame_wait_ms);
  if (now_ns_ >= 0) now.stamp_ns = now_ns_ + period_ns;
  return Status::kOk;
}

/// Goes on with the exchange until every drive that is heard has confirmed that it is disabled.
/// `left` names the joints whose drives may have power.
Status EthercatHal::stop_drives(Message& left) {
  const std::int64_t began_ns = clock_ns();
  const std::int64_t longest_ns = std::int64_t{1'000'000} * master_.stop_ms() +
                                  std::int64_t{1000} * master_.period_us() * kLater;
  const auto awaited = [&] {
    for (int j = 0; j < kDof; ++j)
      if (!master_.confirmed(j) && !master_.lost(j) && !socket_.lost()) return true;
    return false;
  };
  while (awaited() && clock_ns() - began_ns < longest_ns) {
    CycleTime now;
    if (wait(now) != Status::kOk) break;
    RobotState state;
    RobotCommand stop;
    stop.mode = mode_;
    (void)read(now, state);
    (void)write(stop);
  }
  const auto waited_ms = static_cast<int>((clock_ns() - began_ns) / 1'000'000);
  for (int j = 0; j < kDof; ++j)
    if (!master_.confirmed(j)) left << (left.empty() ? "" : ", ") << label(j, master_.slave(j));
  if (left.empty()) return Status::kOk;
  left << ": no statusword has confirmed within " << waited_ms
       << " ms that the drive is disabled; its motor may have power: cut it by the emergency stop,"
          " then check power and cabling of the drive";
  return Status::kBusTimeout;
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
