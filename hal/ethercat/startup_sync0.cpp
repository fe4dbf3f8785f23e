// Startup: SYNC0 of every slave (IEC 61158-4-12, distributed clocks): its clock must be near that
// of the first; then period and start time are written, and the pulses are switched on. A start
// time that has passed by then is written again: its pulses would begin when the clock has wrapped.
#include <algorithm>

#include "hal/cia402/hex.hpp"
#include "hal/ethercat/startup.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ethercat {
namespace {

/// Steps with one slave.
enum Step : int { kFollow, kDifference, kOff, kTime, kCycle, kStart, kOn, kJudge };

constexpr std::int64_t kAhead_ns =
    100'000'000;            // from reading the time to the first pulse, at least
constexpr int kStarts = 5;  // start times of a slave that pass unused
/// Beyond it a clock is not said to be synchronous. The IgH EtherCAT Master waits for the same,
/// EC_DC_MAX_SYNC_DIFF_NS in master/fsm_slave_config.c, and then goes on with a warning.
constexpr std::int64_t kMostApart_ns = 10'000;

}  // namespace

Message Startup::code_text(std::uint16_t code) const {
  Message text(al_code_text(code));
  text << " (" << std::string_view(cia402::hex(code)) << ")";
  if (!ethercat_->has_sync0() && concerns_sync0(code))
    text << "; add [ethercat] sync0_us, for example " << period_us_ / 2 << ", half of the period";
  return text;
}

/// With SYNC0 every slave needs a clock, and the first one of 64 bits: after the wrap of a shorter
/// one it is not known where in a period a frame comes.
Status Startup::judge_clock() {
  const std::uint16_t features = at().features;
  const bool has_it = at_ > 0 || (features & kHasLongClock) != 0;
  if (!ethercat_->has_sync0() || (at().has_clock() && has_it)) return Status::kOk;
  Message what(at().has_clock() ? "its clock has 32 bits" : "has no clock");
  what << " (0008h is " << std::string_view(cia402::hex(features))
       << "), but [ethercat] sync0_us is " << ethercat_->sync0_us << ": "
       << (at().has_clock() ? "SYNC0 needs 64 bits in slave 1" : "SYNC0 needs one in every slave")
       << "; leave sync0_us out if the drives can be synchronized by the frame";
  return refuse(Status::kRefusedByRobot, what);
}

Request Startup::sync0_request() const {
  const std::uint16_t station = at().boxes.station;
  const auto on_or_off = [station](std::uint16_t value) {
    return Request::number(Command::kFpwr, address_of(station, kDcControlReg), value);
  };
  switch (step_) {
    case kDifference: return Request(Command::kFprd, address_of(station, kTimeDifferenceReg), 4);
    case kOff: return on_or_off(0);
    case kCycle:
      return Request::number(Command::kFpwr, address_of(station, kSyncCycleReg),
                             static_cast<std::uint32_t>(1000 * period_us_));
    case kStart:
      return Request::number(Command::kFpwr, address_of(station, kSyncStartReg),
                             static_cast<std::uint64_t>(start_ns_));
    case kOn: return on_or_off(kSync0On);
    default: return Request(Command::kFrmw, address_of(kFirstStation, kSystemTimeReg), 8);
  }
}

Status Startup::take_sync0(const Answer& answer) {
  if (answer.counter < 1)
    return refuse(Status::kRefusedByRobot, "does not take SYNC0 (registers 092Ch, 0980h to 09A3h)");
  switch (step_++) {
    case kDifference: return judge_difference(get<std::uint32_t>(answer.data));
    case kTime: plan_start(get<std::int64_t>(answer.data)); break;
    case kJudge: return judge_start(get<std::int64_t>(answer.data));
    default: break;
  }
  return Status::kOk;
}

/// Bit 31 is the sign. The first slave has nothing to follow.
Status Startup::judge_difference(std::uint32_t shown) {
  const std::int64_t apart_ns = at_ == 0 ? 0 : shown & 0x7FFFFFFF;
  if (apart_ns <= kMostApart_ns) {
    apart_ns_ = std::max(apart_ns_, apart_ns);
    return Status::kOk;
  }
  step_ = kFollow;
  if (now_ns_ - since_ns_ <= ethercat_->state_ms * kMillisecond_ns) return Status::kOk;
  Message what("its clock does not follow that of slave 1: they are ");
  what << static_cast<std::size_t>(apart_ns) << " ns apart (092Ch) after [ethercat] state_ms, "
       << ethercat_->state_ms << " ms, at most " << static_cast<std::size_t>(kMostApart_ns);
  return refuse(Status::kRefusedByRobot, what);
}

/// The first time read is the phase of all frames.
void Startup::plan_start(std::int64_t reference_ns) {
  if (at_ == 0 && attempts_ == 0) phase_ns_ = reference_ns;
  const auto phase = static_cast<std::uint64_t>(phase_ns_);
  const std::uint64_t since = static_cast<std::uint64_t>(reference_ns) - phase;
  const std::uint64_t period = std::uint64_t{1000} * static_cast<unsigned>(period_us_);
  const std::uint64_t whole = (since + kAhead_ns) / period + 1;
  start_ns_ = static_cast<std::int64_t>(
      phase + whole * period + std::uint64_t{1000} * static_cast<unsigned>(ethercat_->sync0_us));
}

Status Startup::judge_start(std::int64_t reference_ns) {
  const std::uint64_t left =
      static_cast<std::uint64_t>(start_ns_) - static_cast<std::uint64_t>(reference_ns);
  if (static_cast<std::int64_t>(left) > 0) {
    next_slave(Stage::kSync0, Stage::kSafeop);
    return Status::kOk;
  }
  step_ = kOff;
  if (++attempts_ < kStarts) return Status::kOk;
  return refuse(Status::kBusTimeout, "SYNC0 cannot be started in time: frames are too slow");
}

}  // namespace tactus::ethercat
