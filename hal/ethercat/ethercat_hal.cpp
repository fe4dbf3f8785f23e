#include "hal/ethercat/ethercat_hal.hpp"

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "hal/net/deadline.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::int64_t kAnswer_ns = 200'000;  // between two looks at the interface while connecting

constexpr int kMostWaits = 100;  // for the frame of a cycle, as others may come

}  // namespace

Status EthercatHal::configure(const EthercatSettings& ethercat, const cia402::Cia402Settings& drive,
                              const Tool& tool, CommandMode mode, int period_us, int arming_ms) {
  ethercat_ = &ethercat;
  mode_ = mode;
  return master_.configure(ethercat, drive, tool, mode, period_us, arming_ms);
}

Status EthercatHal::connect(CommandMode mode) {
  static_cast<void>(disconnect());
  if (ethercat_ == nullptr || mode != mode_) return fault_ = Status::kNotStarted;
  fault_ = socket_.open(master_.interface(), master_.why());
  if (fault_ == Status::kOk) fault_ = start_up();
  if (fault_ != Status::kOk) {
    const Message why = master_.why();
    master_.leave();
    send();
    master_.why() = why;
    socket_.close();
  }
  return fault_;
}

Status EthercatHal::start_up() {
  const Deadline deadline(ethercat_->connect_ms);
  began_ns_ = Deadline::now_ns();
  master_.connect(socket_.address(), 0);
  while (deadline.left_ns() > 0) {
    receive();
    TRY(judge_link());
    const Status status = master_.connecting(Deadline::now_ns() - began_ns_);
    send();
    if (status != Status::kArming) return status;
    const std::int64_t due_ns = master_.until_due_ns(Deadline::now_ns() - began_ns_);
    if (socket_.wait(due_ns > 0 ? std::min(due_ns, kAnswer_ns) : kAnswer_ns)) continue;
    master_.why() = Message("a signal ended the start-up; no drive was enabled");
    return Status::kHalted;
  }
  master_.why() = Message("the drives are not ready after [ethercat] connect_ms, ");
  master_.why() << ethercat_->connect_ms << " ms";
  return Status::kBusTimeout;
}

/// Frames other than the awaited one are counted; further ones wait for the next cycle.
void EthercatHal::receive() {
  LoopBound<kMostFrames> frames;
  for (int i = 0; i < kMostFrames && socket_.receive(frame_); ++i) {
    frames.tick();
    master_.receive(frame_);
    if (!master_.awaits()) return;
  }
}

/// A frame that could not be sent does not return, and is counted as lost.
void EthercatHal::send() {
  if (master_.take(frame_)) (void)socket_.send(frame_);
}

Status EthercatHal::judge_link() {
  if (!socket_.lost()) return Status::kOk;
  master_.why() = Message("interface ");
  master_.why() << master_.interface()
                << ": it is down or gone; check the cable, set the interface up again";
  return Status::kConnectionLost;
}

Status EthercatHal::read(const CycleTime& now, RobotState& state) {
  now_ns_ = now.stamp_ns;
  receive();
  if (fault_ == Status::kOk) fault_ = judge_link();
  const Status status = master_.read(now, state);
  if (fault_ == Status::kOk) fault_ = status;
  return fault_;
}

Status EthercatHal::write(const RobotCommand& command) {
  RobotCommand sent = command;
  if (fault_ != Status::kOk) sent.request = DriveRequest::kDisable;
  master_.write(sent);
  send();
  return fault_;
}

/// One period after the last cycle, plus the correction by the reference clock. Periods that were
/// missed are left out.
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
