#include "sim_plant/drives/axis.hpp"

#include <algorithm>
#include <cmath>

#include "sim_plant/drives/dictionary.hpp"

namespace tactus::drives {
namespace {

using cia402::State;

constexpr Slot kAbortOption = slot_of(0x6007), kQuickStopOption = slot_of(0x605A),
               kShutdownOption = slot_of(0x605B), kDisableOption = slot_of(0x605C),
               kFaultOption = slot_of(0x605E), kProfileDeceleration = slot_of(0x6084),
               kQuickDeceleration = slot_of(0x6085), kPeriodValue = slot_of(0x60C2, 1),
               kPeriodIndex = slot_of(0x60C2, 2);
constexpr std::int64_t kCoast = 0, kSlowRamp = 1, kFirstThatStays = 5;
constexpr std::uint16_t kResetBit = 0x0080;
constexpr std::uint16_t kReferenced = 0x4000;  // of the statusword, the manufacturer's

std::uint16_t bits_of(State state) {
  for (const cia402::StatePattern& row : cia402::kStatePatterns)
    if (row.state == state) return row.value;
  return 0;
}

constexpr double kTwoPi = 6.28318530717958647693;
constexpr double kStandstill_rad_s = 0.005;
constexpr double kLongestStop_s = 2.0;   // then the brake closes in motion
constexpr double kBrakeMonitor_s = 0.5;  // a brake that has not opened by then blocks the motor
constexpr std::uint16_t kBlocked = 0x7121, kOverspeed = 0x8400, kFollowingError = 0x8611;
constexpr std::int64_t kNoWindow = 0xFFFFFFFF;
constexpr std::int64_t kHomingMode = 6, kCsp = 8, kCsv = 9, kCst = 10;
constexpr Slot kPosition = slot_of(0x6064), kWindow = slot_of(0x6065),
               kWindowTime = slot_of(0x6066), kVelocity = slot_of(0x606C),
               kTarget = slot_of(0x6071), kDemand = slot_of(0x6074), kActual = slot_of(0x6077),
               kCurrent = slot_of(0x6078), kTargetPosition = slot_of(0x607A),
               kResolution = slot_of(0x608F, 1), kRevolutions = slot_of(0x608F, 2),
               kGearMotor = slot_of(0x6091, 1), kGearShaft = slot_of(0x6091, 2),
               kPositionOffset = slot_of(0x60B0), kTorqueOffset = slot_of(0x60B2),
               kError = slot_of(0x60F4), kOutputs = slot_of(0x60FE, 1),
               kTargetVelocity = slot_of(0x60FF);

/// Rounds and keeps within the integers of `bits` bits.
std::int64_t rounded(double value, int bits) {
  const double highest = std::ldexp(1.0, bits - 1) - 1.0;
  return std::llround(std::clamp(value, -highest - 1.0, highest));
}

double real(std::int64_t value) {
  return static_cast<double>(value);
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

double Axis::rad_per_increment() const {
  const double motor_rad =
      kTwoPi * real(dictionary_.get(kRevolutions)) / real(dictionary_.get(kResolution));
  return motor_rad * real(dictionary_.get(kGearShaft)) / real(dictionary_.get(kGearMotor));
}

/// The unit in 60A9h: revolutions of the shaft per second or minute by its exponent of ten, or
/// increments/s.
double Axis::velocity_unit() const {
  const std::int64_t unit = dictionary_.get(kVelocityUnit);
  if ((unit >> 16 & 0xFF) != 0xB4) return rad_per_increment();
  const double time_s = (unit >> 8 & 0xFF) == 0x47 ? 60.0 : 1.0;
  const std::int64_t byte = unit >> 24 & 0xFF, exponent = byte < 128 ? byte : byte - 256;
  return kTwoPi / time_s * std::pow(10.0, real(exponent));
}

double Axis::torque_unit() const {
  return real(dictionary_.get(kRatedTorque)) * 1e-6;
}

double Axis::torque_limit() const {
  return std::min(settings_.max_torque_Nm, real(dictionary_.get(kMaxTorque)) * torque_unit());
}

bool Axis::servoed() const {
  if (motion_ == Motion::kOff) return false;
  return motion_ != Motion::kFollow || dictionary_.get(kDisplay) != kCst;
}

bool Axis::homes() const {
  return motion_ == Motion::kFollow && dictionary_.get(kDisplay) == kHomingMode;
}

std::uint16_t Axis::begin_period(const JointSample& sample, double period_s,
                                 bool own_feed_forward) {
  dq_ = sample.dq;
  update_brake(sample, period_s);
  if (homes() && !brake_) homing_.step(sample.q, rad_per_increment());
  const std::int64_t target = dictionary_.get(kTargetPosition);
  feed_forward_ = real(dictionary_.get(kVelocityOffset)) * velocity_unit();
  if (own_feed_forward && has_target_)
    feed_forward_ += real(target - target_before_) * rad_per_increment() / period_s;
  target_before_ = target;
  has_target_ = powered();
  if (motion_ == Motion::kRamp) {
    stopping_s_ += period_s;
    const bool still = ramp_ == 0.0 && std::abs(sample.dq) < kStandstill_rad_s;
    if (still || stopping_s_ > kLongestStop_s) finish_stop();
  }
  return powered() ? watch(sample, period_s) : std::uint16_t{0};
}

/// The brake opens when operation has been enabled for long enough.
void Axis::update_brake(const JointSample& sample, double period_s) {
  if (motion_ != Motion::kFollow || !brake_) return;
  const std::int64_t mode = dictionary_.get(kDisplay);
  if (mode != kHomingMode && (mode < kCsp || mode > kCst)) return;
  enabled_s_ += period_s;
  // The loop begins with the torque that the brake has held.
  servo_.start(sample.gravity_Nm - real(dictionary_.get(kTorqueOffset)) * torque_unit());
  if (!brake_stuck_ && enabled_s_ > settings_.brake_release_s) brake_ = false;
}

/// Returns the error that the drive finds in its own motion.
std::uint16_t Axis::watch(const JointSample& sample, double period_s) {
  if (brake_ && enabled_s_ > std::max(kBrakeMonitor_s, 2.0 * settings_.brake_release_s))
    return kBlocked;
  if (std::abs(sample.dq) > real(dictionary_.get(kMaxSpeed)) * kTwoPi / 60.0) return kOverspeed;
  const bool positioned =
      motion_ == Motion::kFollow && !brake_ && dictionary_.get(kDisplay) == kCsp;
  const std::int64_t window = dictionary_.get(kWindow);
  const double error_rad = real(dictionary_.get(kTargetPosition)) * rad_per_increment() +
                           homing_.origin_rad() - sample.q;
  const bool beyond =
      positioned && window != kNoWindow && std::abs(error_rad) > real(window) * rad_per_increment();
  beyond_s_ = beyond ? beyond_s_ + period_s : 0.0;
  const double patience_s = real(dictionary_.get(kWindowTime)) * 1e-3;
  return beyond && beyond_s_ > patience_s ? kFollowingError : std::uint16_t{0};
}

double Axis::torque(const JointSample& sample, double dt_s) {
  limited_ = false;
  switch (motion_) {
    case Motion::kOff: demand_Nm_ = tau_Nm_ = 0.0; break;
    case Motion::kFollow: tau_Nm_ = follow(sample, dt_s); break;
    case Motion::kRamp:
    case Motion::kHold: {
      const double change = deceleration_ * dt_s;
      ramp_ = motion_ == Motion::kHold ? 0.0 : ramp_ - std::clamp(ramp_, -change, change);
      demand_Nm_ = tau_Nm_ =
          servo_.step(settings_.gains, ramp_, sample.dq, settings_.max_torque_Nm, dt_s);
    }
  }
  return tau_Nm_;
}

double Axis::follow(const JointSample& sample, double dt_s) {
  const double limit = torque_limit(),
               offset = real(dictionary_.get(kTorqueOffset)) * torque_unit();
  const std::int64_t mode = dictionary_.get(kDisplay);
  double wanted = 0.0;
  if (mode == kCst) {
    wanted = real(dictionary_.get(kTarget)) * torque_unit() + offset;
  } else if (brake_) {
    wanted = servo_.integral_Nm + offset;
  } else if (mode == kHomingMode) {
    wanted =
        servo_.step(settings_.gains, homing_.velocity(rad_per_increment()), sample.dq, limit, dt_s);
  } else if (mode == kCsv || mode == kCsp) {
    double v_c = feed_forward_;
    if (mode == kCsv)
      v_c = real(dictionary_.get(kTargetVelocity) + dictionary_.get(kVelocityOffset)) *
            velocity_unit();
    else
      v_c += settings_.gains.kp *
             (real(dictionary_.get(kTargetPosition) + dictionary_.get(kPositionOffset)) *
                  rad_per_increment() +
              homing_.origin_rad() - sample.q);
    wanted = servo_.step(settings_.gains, v_c, sample.dq, limit, dt_s) + offset;
  }
  demand_Nm_ = std::clamp(wanted, -limit, limit);
  limited_ = demand_Nm_ != wanted;
  const bool adds = settings_.gravity_by_drive && mode == kCst;
  return std::clamp(demand_Nm_ + (adds ? sample.gravity_Nm : 0.0), -settings_.max_torque_Nm,
                    settings_.max_torque_Nm);
}

void Axis::report(const JointSample& sample) {
  const double scale = rad_per_increment();
  homing_.measure(sample.q);
  const double q = sample.q - homing_.origin_rad();
  const auto position = static_cast<std::int32_t>(
      static_cast<std::uint32_t>(std::llround(std::clamp(q / scale, -9e18, 9e18))));
  dictionary_.set(kPosition, position);
  dictionary_.set(kVelocity, rounded(sample.dq / velocity_unit(), 32));
  dictionary_.set(kActual, rounded(tau_Nm_ / torque_unit(), 16));
  dictionary_.set(kCurrent, rounded(tau_Nm_ / torque_unit(), 16));
  dictionary_.set(kDemand, rounded(demand_Nm_ / torque_unit(), 16));
  dictionary_.set(kError, rounded(real(dictionary_.get(kTargetPosition) - position), 32));
  const std::int64_t outputs = dictionary_.get(kOutputs);
  dictionary_.set(kOutputs, brake_ ? outputs | 1 : outputs & ~std::int64_t{1});
}

}  // namespace tactus::drives
