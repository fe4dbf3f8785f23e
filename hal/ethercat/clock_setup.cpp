#include "hal/ethercat/clock_setup.hpp"

#include <algorithm>

#include "hal/cia402/hex.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::uint16_t kFilterReset = 0x1000;

/// Steps of SYNC0 with one slave.
enum Step : int { kFollow, kDifference, kOff, kTime, kCycle, kStart, kOn, kJudge };

constexpr std::int64_t kAhead_ns =
    100'000'000;            // from reading the time to the first pulse, at least
constexpr int kStarts = 5;  // start times of a slave that pass unused
/// Beyond it a clock does not count as synchronous. The IgH EtherCAT Master waits for the same,
/// EC_DC_MAX_SYNC_DIFF_NS in master/fsm_slave_config.c, and then continues with a warning.
constexpr std::int64_t kMostApart_ns = 10'000;

}  // namespace

void ClockSetup::reset(const EthercatSettings& ethercat, int period_us) {
  ethercat_ = &ethercat;
  period_us_ = period_us;
  all_have_clocks_ = true;
  phase_ns_ = apart_ns_ = 0;
}

/// With SYNC0 every slave needs a clock, and the first slave one of 64 bits: the wrap of a shorter
/// clock loses the phase of the frames.
Status ClockSetup::judge(int place) {
  place_ = place;
  all_have_clocks_ = all_have_clocks_ && at().has_clock();
  const std::uint16_t features = at().features;
  const bool has_it = place > 0 || (features & kHasLongClock) != 0;
  if (!ethercat_->has_sync0() || (at().has_clock() && has_it)) return Status::kOk;
  Message what(at().has_clock() ? "its clock has 32 bits" : "has no clock");
  what << " (0008h is " << std::string_view(cia402::hex(features))
       << "), but [ethercat] sync0_us is " << ethercat_->sync0_us << ": "
       << (at().has_clock() ? "SYNC0 needs 64 bits in slave 1" : "SYNC0 needs one in every slave")
       << "; leave sync0_us out if the drives can be synchronized by the frame";
  return refuse(Status::kRefusedByRobot, what);
}

void ClockSetup::enter(Stage stage, std::int64_t now_ns) {
  stage_ = stage;
  place_ = step_ = attempts_ = 0;
  since_ns_ = now_ns;
}

/// The same stage with the next slave, or the stage after it.
void ClockSetup::next_slave(Stage then, std::int64_t now_ns) {
  const int next = place_ + 1;
  enter(next < kDof ? stage_ : then, now_ns);
  if (next < kDof) place_ = next;
}

Status ClockSetup::refuse(Status status, std::string_view what) {
  why_ = label(line_.joint(place_), at());
  why_ << ": " << what;
  return status;
}

Status ClockSetup::take(const Answer& answer, std::int64_t now_ns) {
  TRY(stage_ == Stage::kSync0 ? take_sync0(answer, now_ns) : take_times(answer, now_ns));
  return stage_ == Stage::kDone ? Status::kOk : Status::kArming;
}

Request ClockSetup::request() const {
  const std::uint16_t station = at().boxes.station;
  switch (stage_) {
    case Stage::kLatch:
      return Request::number<std::uint32_t>(Command::kBwr, address_of(0, kPortTimesReg), 0);
    case Stage::kTimes: return Request(Command::kFprd, address_of(station, kPortTimesReg), 32);
    case Stage::kOffsets: {
      Request request(Command::kFpwr, address_of(station, kTimeOffsetReg), 12);
      const Slave& first = line_.at(0);
      put(&request.data[0],
          first.local_ns + static_cast<std::uint64_t>(at().delay_ns) - at().local_ns);
      put(&request.data[8], static_cast<std::uint32_t>(at().delay_ns));
      return request;
    }
    case Stage::kFilter:
      return Request::number(Command::kBwr, address_of(0, kTimeSpeedReg), kFilterReset);
    case Stage::kSync0: return sync0_request();
    default: return Request(Command::kFrmw, address_of(kFirstStation, kSystemTimeReg), 8);
  }
}

Status ClockSetup::take_times(const Answer& answer, std::int64_t now_ns) {
  const Stage steered = ethercat_->has_sync0() ? Stage::kSync0 : Stage::kDone;
  switch (stage_) {
    case Stage::kLatch: enter(Stage::kTimes, now_ns); break;
    case Stage::kTimes:
      if (answer.counter != 1) return refuse(Status::kBusTimeout, "its clock cannot be read");
      line_.at(place_).loop_ns =
          get<std::uint32_t>(answer.data + 4) - get<std::uint32_t>(answer.data);
      line_.at(place_).local_ns = get<std::uint64_t>(answer.data + 24);
      next_slave(Stage::kOffsets, now_ns);
      if (stage_ == Stage::kOffsets) set_delays();
      break;
    case Stage::kOffsets: next_slave(Stage::kFilter, now_ns); break;
    case Stage::kFilter:
      enter(ethercat_->clock_frames > 0 ? Stage::kSteer : steered, now_ns);
      break;
    default:
      if (++step_ >= ethercat_->clock_frames) enter(steered, now_ns);
  }
  return Status::kOk;
}

/// The difference of the loops of two neighbours is the time between them, there and back.
void ClockSetup::set_delays() {
  std::int64_t delay_ns = 0;
  for (int i = 0; i < kDof; ++i) {
    Slave& slave = line_.at(i);
    if (i > 0) {
      const Slave& before = line_.at(i - 1);
      const std::int64_t own_ns = i + 1 == kDof ? 0 : slave.loop_ns;
      delay_ns += (std::int64_t{before.loop_ns} - own_ns) / 2;
    }
    slave.delay_ns = delay_ns;
  }
}

// A start time that has passed when it is written is written again: its pulses would begin only
// when the clock has wrapped.
Request ClockSetup::sync0_request() const {
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

Status ClockSetup::take_sync0(const Answer& answer, std::int64_t now_ns) {
  if (answer.counter < 1)
    return refuse(Status::kRefusedByRobot, "does not take SYNC0 (registers 092Ch, 0980h to 09A3h)");
  switch (step_++) {
    case kDifference: return judge_difference(get<std::uint32_t>(answer.data), now_ns);
    case kTime: plan_start(get<std::int64_t>(answer.data)); break;
    case kJudge: return judge_start(get<std::int64_t>(answer.data), now_ns);
    default: break;
  }
  return Status::kOk;
}

/// Bit 31 is the sign. The first slave has nothing to follow.
Status ClockSetup::judge_difference(std::uint32_t shown, std::int64_t now_ns) {
  const std::int64_t apart_ns = place_ == 0 ? 0 : shown & 0x7FFFFFFF;
  if (apart_ns <= kMostApart_ns) {
    apart_ns_ = std::max(apart_ns_, apart_ns);
    return Status::kOk;
  }
  step_ = kFollow;
  if (now_ns - since_ns_ <= ethercat_->state_ms * kMillisecond_ns) return Status::kOk;
  Message what("its clock does not follow that of slave 1: they are ");
  what << static_cast<std::size_t>(apart_ns) << " ns apart (092Ch) after [ethercat] state_ms, "
       << ethercat_->state_ms << " ms, at most " << static_cast<std::size_t>(kMostApart_ns);
  return refuse(Status::kRefusedByRobot, what);
}

/// The first time read is the phase of all frames.
void ClockSetup::plan_start(std::int64_t reference_ns) {
  if (place_ == 0 && attempts_ == 0) phase_ns_ = reference_ns;
  const auto phase = static_cast<std::uint64_t>(phase_ns_);
  const std::uint64_t since = static_cast<std::uint64_t>(reference_ns) - phase;
  const std::uint64_t period = std::uint64_t{1000} * static_cast<unsigned>(period_us_);
  const std::uint64_t whole = (since + kAhead_ns) / period + 1;
  start_ns_ = static_cast<std::int64_t>(
      phase + whole * period + std::uint64_t{1000} * static_cast<unsigned>(ethercat_->sync0_us));
}

Status ClockSetup::judge_start(std::int64_t reference_ns, std::int64_t now_ns) {
  const std::uint64_t left =
      static_cast<std::uint64_t>(start_ns_) - static_cast<std::uint64_t>(reference_ns);
  if (static_cast<std::int64_t>(left) > 0) {
    next_slave(Stage::kDone, now_ns);
    return Status::kOk;
  }
  step_ = kOff;
  if (++attempts_ < kStarts) return Status::kOk;
  return refuse(Status::kBusTimeout, "SYNC0 cannot be started in time: frames are too slow");
}

}  // namespace tactus::ethercat
