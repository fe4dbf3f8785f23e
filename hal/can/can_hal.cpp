#include "hal/can/can_hal.hpp"

#include <cerrno>
#include <ctime>

#include "hal/net/deadline.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::can {
namespace {

constexpr std::int64_t kAnswer_ns = 1'000'000;  // between two looks at the bus while connecting
constexpr int kMostUnsent = 3;  // cycles in a row whose frames a full queue may refuse

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

Status CanHal::configure(const CanSettings& can, const cia402::Cia402Settings& drive,
                         const Tool& tool, CommandMode mode, int period_us, int arming_ms) {
  can_ = &can;
  mode_ = mode;
  return master_.configure(can, drive, tool, mode, period_us, arming_ms);
}

Status CanHal::connect(CommandMode mode) {
  static_cast<void>(disconnect());
  if (can_ == nullptr || mode != mode_) return fault_ = Status::kNotStarted;
  fault_ = open();
  if (fault_ == Status::kOk) fault_ = start_up();
  if (fault_ != Status::kOk)
    for (CanSocket& socket : sockets_) socket.close();
  return fault_;
}

Status CanHal::open() {
  for (int bus = 0; bus < master_.buses(); ++bus) {
    std::array<CanFilter, CanMaster::kMaxFilters> filters;
    const int count = master_.filters(bus, filters);
    const bool fd = can_->frames == Frames::kFd;
    TRY(sockets_[static_cast<std::size_t>(bus)].open(master_.interface(bus), fd, filters.data(),
                                                     count, master_.why()));
    TRY(judge_queue(master_.interface(bus), sockets_[static_cast<std::size_t>(bus)].queue_frames(),
                    master_.cycle_frames(bus), master_.why()));
    unsent_[static_cast<std::size_t>(bus)] = 0;
  }
  return Status::kOk;
}

/// Every round looks at all buses, so the start-up is as fast as the drives answer.
Status CanHal::start_up() {
  const Deadline deadline(can_->connect_ms);
  const std::int64_t whole_ns = deadline.left_ns();
  master_.connect(0);
  while (deadline.left_ns() > 0) {
    const std::int64_t now_ns = whole_ns - deadline.left_ns();
    for (int bus = 0; bus < master_.buses(); ++bus) {
      receive(bus, now_ns);
      TRY(judge_link(bus));
    }
    const Status status = master_.connecting(now_ns);
    TRY(send());
    if (status != Status::kArming) return status;
    const CanSocket& awaited = sockets_[static_cast<std::size_t>(master_.awaited_bus())];
    if (awaited.wait(kAnswer_ns) == WaitResult::kInterrupted) {
      master_.why() = Message("a signal ended the start-up; no drive was enabled");
      return Status::kHalted;
    }
  }
  master_.why() = Message("the drives are not ready after [can] connect_ms, ");
  master_.why() << can_->connect_ms << " ms";
  return Status::kBusTimeout;
}

void CanHal::receive(int bus, std::int64_t now_ns) {
  CanSocket& socket = sockets_[static_cast<std::size_t>(bus)];
  const int count = socket.receive(frames_.data(), static_cast<int>(frames_.size()));
  for (int i = 0; i < count; ++i)
    master_.receive(bus, frames_[static_cast<std::size_t>(i)], now_ns);
}

/// A controller that is error passive still works; the time-outs of its drives decide whether that
/// is enough.
Status CanHal::judge_link(int bus) {
  const LinkHealth& health = sockets_[static_cast<std::size_t>(bus)].health();
  if (!health.lost && !health.bus_off && health.restarted == 0) return Status::kOk;
  master_.why() = Message("bus ");
  master_.why() << master_.interface(bus)
                << (health.lost ? ": the interface is down or gone"
                                : ": bus-off: the controller has taken itself off the bus")
                << "; check cabling, termination and bit rate, set the interface up again";
  return Status::kConnectionLost;
}

/// The master gets the time even if a bus has failed: it stops the drives on the others.
Status CanHal::read(const CycleTime& now, RobotState& state) {
  now_ns_ = now.stamp_ns;
  for (int bus = 0; bus < master_.buses(); ++bus) {
    receive(bus, now.stamp_ns);
    if (fault_ == Status::kOk) fault_ = judge_link(bus);
  }
  const Status status = master_.read(now, state);
  if (fault_ == Status::kOk) fault_ = status;
  return fault_;
}

/// After a bus has failed, the drives on the other buses still get the command to stop.
Status CanHal::write(const RobotCommand& command) {
  RobotCommand sent = command;
  if (fault_ != Status::kOk) sent.request = DriveRequest::kDisable;
  master_.write(sent);
  const Status status = send();
  if (fault_ == Status::kOk) fault_ = status;
  return fault_;
}

Status CanHal::send() {
  Status status = Status::kOk;
  for (int bus = 0; bus < master_.buses(); ++bus) {
    Outbox& outbox = master_.outbox(bus);
    if (outbox.count() == 0) continue;
    int& unsent = unsent_[static_cast<std::size_t>(bus)];
    const Sent sent = sockets_[static_cast<std::size_t>(bus)].send(outbox.frames(), outbox.count());
    outbox.clear();
    unsent = sent == Sent::kQueueFull ? unsent + 1 : 0;
    if (sent == Sent::kLost) status = judge_link(bus);
    if (unsent <= kMostUnsent) continue;
    master_.why() = Message("bus ");
    master_.why() << master_.interface(bus) << ": its queue was full in " << unsent
                  << " cycles in a row: nobody acknowledges, or the bus is overloaded; txqueuelen"
                     " must hold the frames of a cycle";
    status = Status::kBusTimeout;
  }
  return status;
}

int CanHal::system_calls() const {
  int calls = 0;
  for (const CanSocket& socket : sockets_) calls += socket.system_calls();
  return calls;
}

/// One more cycle of the exchange, a period after the one before.
void CanHal::exchange(std::int64_t& slept_ns) {
  const std::int64_t period_ns = std::int64_t{1000} * master_.period_us();
  const std::int64_t woke_ns = sleep_from(slept_ns, period_ns);
  now_ns_ += woke_ns - slept_ns;
  slept_ns = woke_ns;
  cia402::exchange_stop(*this, {now_ns_}, mode_);
}

/// A drive on a failed bus stays unreachable; a silent one may report again.
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
  for (master_.release_drives(); master_.releasing();) exchange(slept_ns);
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
