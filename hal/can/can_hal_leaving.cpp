// CanHal: how it leaves the drives.
#include <cerrno>
#include <ctime>

#include "hal/can/can_hal.hpp"
#include "hal/net/deadline.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::can {
namespace {

/// Sleeps until a period after `from_ns`, and returns this time, or now if it has passed for long.
std::int64_t sleep_from(std::int64_t from_ns, std::int64_t period_ns) {
  const std::int64_t until_ns = from_ns + period_ns, now_ns = Deadline::now_ns();
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
  cia402::exchange_stop(*this, {now_ns_}, mode_);
}

/// A drive on a bus that has failed is not heard any more; one that is silent may be again.
bool CanHal::awaits(int joint) const {
  const LinkHealth& wire = health(master_.node(joint).bus);
  return !master_.confirmed(joint) && !wire.lost && !wire.bus_off;
}

/// Goes on with the exchange until every drive on a bus that works has confirmed that it is
/// disabled, then ends its watch over this program.
Status CanHal::stop_drives(Message& left) {
  const std::int64_t began_ns = Deadline::now_ns();
  const std::int64_t longest_ns =
      cia402::longest_leaving_ns(master_.stop_ms(), master_.period_us());
  std::int64_t slept_ns = began_ns;
  const auto awaited = [this](int joint) { return awaits(joint); };
  while (cia402::any_joint(awaited) && slept_ns - began_ns < longest_ns) exchange(slept_ns);
  const std::int64_t waited_ns = slept_ns - began_ns;
  for (master_.bid_farewell(); master_.bids_farewell();) exchange(slept_ns);
  (void)sleep_from(slept_ns, std::int64_t{1000} * master_.period_us());
  return cia402::judge_stop(master_, waited_ns, left);
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
