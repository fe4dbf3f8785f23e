#include "sim_plant/drives/axis_homing.hpp"

#include "hal/cia402/protocol.hpp"

namespace tactus::drives {
namespace {

constexpr Slot kOffset = slot_of(0x607C), kMethod = slot_of(0x6098), kToSwitch = slot_of(0x6099, 1),
               kFromSwitch = slot_of(0x6099, 2);
constexpr std::int64_t kLowerSwitch = 17, kUpperSwitch = 18, kHere = 35, kHereToo = 37;

}  // namespace

void AxisHoming::power_on(const HomingSettings& settings) {
  settings_ = settings;
  dictionary_.set(kOffset, settings.offset);
  phase_ = Phase::kIdle;
  controlword_ = 0;
  origin_rad_ = 0.0;
  referenced_ = counts_ = !settings.incremental;
}

void AxisHoming::command(std::uint16_t controlword, bool active) {
  const bool starts = (controlword & ~controlword_ & cia402::kStartHoming) != 0;
  const bool moves = phase_ == Phase::kSeeks || phase_ == Phase::kReturns;
  controlword_ = active ? controlword : std::uint16_t{0};
  if (active && starts) {
    phase_ = Phase::kSeeks;
    referenced_ = referenced_ && !settings_.incremental;
  } else if (moves && (controlword_ & cia402::kStartHoming) == 0) {
    phase_ = Phase::kIdle;
  }
}

void AxisHoming::step(double q, double scale) {
  if (phase_ != Phase::kSeeks && phase_ != Phase::kReturns) return;
  if (fault_ == HomingFault::kEndless) return;
  if (fault_ != HomingFault::kNone) {
    phase_ = Phase::kError;
    return;
  }
  const std::int64_t method = dictionary_.get(kMethod);
  const bool lower = method == kLowerSwitch, upper = method == kUpperSwitch;
  const bool closed = lower ? q <= settings_.lower_rad : q >= settings_.upper_rad;
  if (method == kHere || method == kHereToo) return attain(q, scale);
  if (!lower && !upper) {
    phase_ = Phase::kError;
  } else if (phase_ == Phase::kSeeks && closed) {
    phase_ = Phase::kReturns;
  } else if (phase_ == Phase::kReturns && !closed) {
    attain(q, scale);
  }
}

void AxisHoming::attain(double q, double scale) {
  origin_rad_ = q - static_cast<double>(dictionary_.get(kOffset)) * scale;
  referenced_ = counts_ = true;
  phase_ = Phase::kAttained;
}

double AxisHoming::velocity(double scale) const {
  if (fault_ == HomingFault::kEndless) return 0.0;
  const std::int64_t method = dictionary_.get(kMethod);
  const double way = method == kLowerSwitch ? -scale : method == kUpperSwitch ? scale : 0.0;
  switch (phase_) {
    case Phase::kSeeks: return way * static_cast<double>(dictionary_.get(kToSwitch));
    case Phase::kReturns: return -way * static_cast<double>(dictionary_.get(kFromSwitch));
    case Phase::kIdle:
    case Phase::kAttained:
    case Phase::kError: break;
  }
  return 0.0;
}

void AxisHoming::measure(double q) {
  if (!counts_) origin_rad_ = q;
  counts_ = true;
}

std::uint16_t AxisHoming::bits() const {
  switch (phase_) {
    case Phase::kIdle: return cia402::kTargetReached;
    case Phase::kAttained: return cia402::kTargetReached | cia402::kHomingAttained;
    case Phase::kError:
      return fault_ == HomingFault::kErrorMoving
                 ? cia402::kHomingError
                 : std::uint16_t{cia402::kHomingError | cia402::kTargetReached};
    case Phase::kSeeks:
    case Phase::kReturns: break;
  }
  return 0;
}

}  // namespace tactus::drives
