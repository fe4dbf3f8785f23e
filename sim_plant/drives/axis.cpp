#include "sim_plant/drives/axis.hpp"

#include <algorithm>
#include <cmath>

#include "sim_plant/drives/slots.hpp"

namespace tactus::drives {
namespace {

using cia402::State;

constexpr Slot kAbortOption = slot_of(0x6007), kQuickStopOption = slot_of(0x605A),
               kShutdownOption = slot_of(0x605B), kDisableOption = slot_of(0x605C),
               kFaultOption = slot_of(0x605E), kProfileDeceleration = slot_of(0x6084),
               kQuickDeceleration = slot_of(0x6085),

               kPeriodValue = slot_of(0x60C2, 1), kPeriodIndex = slot_of(0x60C2, 2);
constexpr std::int64_t kCoast = 0, kSlowRamp = 1, kFirstThatStays = 5;
constexpr std::uint16_t kResetBit = 0x0080;
constexpr std::uint16_t kReferenced = 0x4000;  // of the statusword, the manufacturer's

std::uint16_t bits_of(State state) {
  for (const cia402::StatePattern& row : cia402::kStatePatterns)
    if (row.state == state) return row.value;
  return 0;
}

}  // namespace

void Axis::power_on(const AxisSettings& settings) {
  settings_ = settings;
  dictionary_.set(kRatedTorque, settings.rated_mNm);
  const double permille = settings.torque_share * settings.max_torque_Nm * 1e6 / settings.rated_mNm;
  dictionary_.set(kVelocityUnit, settings.velocity_unit);
  dictionary_.set(kMaxTorque, std::llround(std::min(permille, 65535.0)));
  dictionary_.set(kMaxSpeed, std::llround(settings.max_speed_rad_s * 9.5492966));  // rpm
  controlword_ = 0;
  brake_stuck_ = false;
  homing_.power_on(settings.homing);
  motion_ = Motion::kOff;
  enter(State::kSwitchOnDisabled);
}

/// A state without power closes the brake and takes a new mode.
void Axis::enter(State state) {
  state_ = state;
  const bool moves = state == State::kOperationEnabled || state == State::kQuickStopActive ||
                     state == State::kFaultReactionActive;
  if (moves) return;
  motion_ = Motion::kOff;
  brake_ = true;
  follow_mode();
}

void Axis::follow_mode() {
  const std::int64_t mode = dictionary_.get(kMode);
  if (motion_ == Motion::kOff && mode != 0) dictionary_.set(kDisplay, mode);
}

bool Axis::command(std::uint16_t controlword, bool causes_gone) {
  const bool reset = (controlword & ~controlword_ & kResetBit) != 0;
  controlword_ = controlword;
  homing_.command(controlword, homes());
  if (reset && state_ == State::kFault && causes_gone) {
    enter(State::kSwitchOnDisabled);
    return true;
  }
  const Command command = command_of(controlword);
  const Transition* row = find_transition(state_, command);
  if (row == nullptr) {
    if (state_ == State::kOperationEnabled && command == Command::kEnableOperation)
      motion_ = Motion::kFollow;  // takes back a stop that leads out of this state
    return false;
  }
  switch (row->number) {
    case 3:
      enter(row->to);
      if (command == Command::kEnableOperation) return this->command(controlword, causes_gone);
      break;
    case 4:
      enter(row->to);
      motion_ = Motion::kFollow;
      enabled_s_ = 0.0;
      has_target_ = false;
      servo_.start(0.0);
      break;
    case 5: stop(dictionary_.get(kDisableOption), row->to, false); break;
    case 8: stop(dictionary_.get(kShutdownOption), row->to, false); break;
    case 11: {
      const std::int64_t option = dictionary_.get(kQuickStopOption);
      enter(row->to);
      stop(option, State::kSwitchOnDisabled, option >= kFirstThatStays);
      break;
    }
    case 16:
      if (!stays_) return false;
      enter(row->to);
      motion_ = Motion::kFollow;
      has_target_ = false;
      break;
    default: enter(row->to);
  }
  return false;
}

/// Begins a stop that ends in `after`, or, if it `stays`, in standstill with the brake open.
void Axis::stop(std::int64_t option, State after, bool stays) {
  if (motion_ == Motion::kRamp && after_ == after && option != kCoast) return;  // it is under way
  after_ = after;
  stays_ = stays;
  servo_.start(tau_Nm_);
  if (option == kCoast || brake_) return finish_stop();
  const bool slow = option == kSlowRamp || option == kFirstThatStays;
  const auto ramp = slow ? kProfileDeceleration : kQuickDeceleration;
  const bool hardest = option == 3 || option == 4 || option >= 7;
  deceleration_ =
      static_cast<double>(dictionary_.get(ramp)) * rad_per_increment() * (hardest ? 4.0 : 1.0);
  motion_ = Motion::kRamp;
  ramp_ = dq_;
  stopping_s_ = 0.0;
}

void Axis::finish_stop() {
  if (!stays_) return enter(after_);
  motion_ = Motion::kHold;
}

void Axis::trip() {
  if (state_ == State::kFault || state_ == State::kFaultReactionActive) return;
  const bool was_moving = powered();
  enter(State::kFaultReactionActive);
  stop(was_moving ? dictionary_.get(kFaultOption) : kCoast, State::kFault, false);
}

bool Axis::abort_connection() {
  switch (dictionary_.get(kAbortOption)) {
    case 1: return true;
    case 2: command(cia402::kDisableVoltage, false); break;
    case 3: command(cia402::kQuickStop, false); break;
    default: break;
  }
  return false;
}

void Axis::disable() {
  if (state_ != State::kFault) enter(State::kSwitchOnDisabled);
}

double Axis::period_s() const {
  const auto value = static_cast<double>(dictionary_.get(kPeriodValue));
  const auto exponent = static_cast<double>(dictionary_.get(kPeriodIndex));
  return std::clamp(value * std::pow(10.0, exponent), 1e-4, 0.1);
}

std::uint16_t Axis::statusword() const {
  unsigned word = bits_of(state_) | cia402::kVoltageEnabled | cia402::kRemote;
  if (limited_) word |= cia402::kInternalLimit;
  if (settings_.homing.shows && homing_.referenced()) word |= kReferenced;
  if (dictionary_.get(kDisplay) == static_cast<int>(cia402::Mode::kHoming))
    return static_cast<std::uint16_t>(word | homing_.bits());
  const bool follows = state_ == State::kOperationEnabled && motion_ == Motion::kFollow && !brake_;
  if (follows) word |= cia402::kFollowsCommand;
  if (beyond_s_ > 0.0) word |= 0x2000;
  return static_cast<std::uint16_t>(word);
}

}  // namespace tactus::drives
