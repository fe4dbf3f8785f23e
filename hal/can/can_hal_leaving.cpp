// CanHal: how it leaves the drives.
#include <cerrno>
#include <ctime>

#include "hal/can/can_hal.hpp"

namespace tactus::can {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr int kLater = 20;  // cycles beyond the longest quick stop

std::int64_t clock_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecond_ns + now.tv_nsec;
}

/// Sleeps until a period after `from_ns`, and returns this time, or now if it has passed for long.
std::int64_t sleep_from(std::int64_t from_ns, std::int64_t period_ns) {
  const std::int64_t until_ns = from_ns + period_ns, now_ns = clock_ns();
  if (now_ns > until_ns + period_ns) return now_ns;
  const timespec until = {until_ns / kSecond_ns, until_ns % kSecond_ns};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
  return until_ns;
}

}  // namespace

/// One more cycle of the exchange, a period after the one before.
void CanHal::exchange(std::int64_t& slept_ns) {
  const std::int64_t period_ns = std::int64_t{1000} * master_.period_us();
  const std::int64_t woke_ns = sleep_from(slept_ns, period_ns);
  now_ns_ += woke_ns - slept_ns;
  slept_ns = woke_ns;
  RobotState state;
  RobotCommand stop;
  stop.mode = mode_;
  (void)read({now_ns_}, state);
  (void)write(stop);
}

/// A drive on a bus that has failed, or one that was lost, is not heard any more.
bool CanHal::awaits(int joint) const {
  const LinkHealth& wire = health(master_.node(joint).bus);
  return !master_.confirmed(joint) && !master_.lost(joint) && !wire.lost && !wire.bus_off;
}

/// Goes on with the exchange until every drive that is heard has confirmed that it is disabled,
/// then ends its watch over this program.
Status CanHal::stop_drives(Message& left) {
  const std::int64_t began_ns = clock_ns();
  const std::int64_t longest_ns = std::int64_t{1'000'000} * master_.stop_ms() +
                                  std::int64_t{1000} * master_.period_us() * kLater;
  std::int64_t slept_ns = began_ns;
  const auto awaited = [&] {
    for (int j = 0; j < kDof; ++j)
      if (awaits(j)) return true;
    return false;
  };
  while (awaited() && slept_ns - began_ns < longest_ns) exchange(slept_ns);
  const auto waited_ms = static_cast<int>((slept_ns - began_ns) / 1'000'000);
  for (master_.bid_farewell(); master_.bids_farewell();) exchange(slept_ns);
  (void)sleep_from(slept_ns, std::int64_t{1000} * master_.period_us());
  return judge_stop(waited_ms, left);
}

/// `left` names the joints whose drives may have power.
Status CanHal::judge_stop(int waited_ms, Message& left) const {
  for (int j = 0; j < kDof; ++j)
    if (!master_.confirmed(j)) left << (left.empty() ? "" : ", ") << label(j, master_.node(j));
  if (left.empty()) return Status::kOk;
  left << ": no statusword has confirmed within " << waited_ms
       << " ms that the drive is disabled; its motor may have power: cut it by the emergency stop,"
          " then check power and cabling of the drive";
  return Status::kBusTimeout;
}

Status CanHal::disconnect() {
  Status status = Status::kOk;
  Message left;
  if (master_.connected() && now_ns_ >= 0) status = stop_drives(left);
  master_.leave();
  (void)send();
  if (status != Status::kOk) master_.why() = left;
  for (CanSocket& socket : sockets_) socket.close();
  fault_ = Status::kNotStarted;
  now_ns_ = -1;
  return status;
}

}  // namespace tactus::can
