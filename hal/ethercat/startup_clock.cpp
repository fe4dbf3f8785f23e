// Startup: the distributed clocks. The clock of the first slave is the reference; the others get
// the offset to it and the delay of the line, and then follow it.
#include "hal/ethercat/startup.hpp"

namespace tactus::ethercat {
namespace {

constexpr std::uint16_t kFilterReset = 0x1000;

}  // namespace

Request Startup::clock_request() const {
  const std::uint16_t station = at().boxes.station;
  switch (stage_) {
    case Stage::kLatch:
      return Request::number<std::uint32_t>(Command::kBwr, address_of(0, kPortTimesReg), 0);
    case Stage::kTimes: return Request(Command::kFprd, address_of(station, kPortTimesReg), 32);
    case Stage::kOffsets: {
      Request request(Command::kFpwr, address_of(station, kTimeOffsetReg), 12);
      const Slave& first = slaves_[static_cast<std::size_t>(order_[0])];
      put(&request.data[0],
          first.local_ns + static_cast<std::uint64_t>(at().delay_ns) - at().local_ns);
      put(&request.data[8], static_cast<std::uint32_t>(at().delay_ns));
      return request;
    }
    case Stage::kFilter:
      return Request::number(Command::kBwr, address_of(0, kTimeSpeedReg), kFilterReset);
    default: return Request(Command::kFrmw, address_of(kFirstStation, kSystemTimeReg), 8);
  }
}

/// Also the stages around it.
Status Startup::take_times(const Answer& answer) {
  const Stage steered = ethercat_->has_sync0() ? Stage::kSync0 : Stage::kSafeop;
  switch (stage_) {
    case Stage::kLatch: enter(Stage::kTimes); break;
    case Stage::kTimes:
      if (answer.counter != 1) return refuse(Status::kBusTimeout, "its clock cannot be read");
      at().loop_ns = get<std::uint32_t>(answer.data + 4) - get<std::uint32_t>(answer.data);
      at().local_ns = get<std::uint64_t>(answer.data + 24);
      next_slave(Stage::kTimes, Stage::kOffsets);
      if (stage_ == Stage::kOffsets) set_delays();
      break;
    case Stage::kOffsets: next_slave(Stage::kOffsets, Stage::kFilter); break;
    case Stage::kFilter: enter(ethercat_->clock_frames > 0 ? Stage::kSteer : steered); break;
    default:
      if (++step_ >= ethercat_->clock_frames) enter(steered);
  }
  return Status::kOk;
}

/// In a line, what is between two slaves takes the difference of their loops, there and back.
void Startup::set_delays() {
  std::int64_t delay_ns = 0;
  for (std::size_t i = 0; i < kDof; ++i) {
    Slave& slave = slaves_[static_cast<std::size_t>(order_[i])];
    if (i > 0) {
      const Slave& before = slaves_[static_cast<std::size_t>(order_[i - 1])];
      const std::int64_t own_ns = i + 1 == kDof ? 0 : slave.loop_ns;
      delay_ns += (std::int64_t{before.loop_ns} - own_ns) / 2;
    }
    slave.delay_ns = delay_ns;
  }
}

}  // namespace tactus::ethercat
