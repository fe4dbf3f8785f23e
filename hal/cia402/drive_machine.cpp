#include "hal/cia402/drive_machine.hpp"

namespace tactus::cia402 {
namespace {

constexpr std::int64_t kHalfPulse_ns = 50'000'000;  // of a fault reset

bool is_fault(State state) {
  return state == State::kFault || state == State::kFaultReactionActive;
}

/// How far up a state is; 0: without power.
int height(State state) {
  switch (state) {
    case State::kReadyToSwitchOn: return 1;
    case State::kSwitchedOn: return 2;
    case State::kOperationEnabled: return 3;
    default: return 0;
  }
}

}  // namespace

std::uint16_t DriveMachine::step(std::uint16_t statusword, Goal goal, std::int64_t now_ns) {
  const State state = state_of(statusword);
  const bool turns_up = goal_ == Goal::kDisabled && goal != Goal::kDisabled;
  if (state != state_ || goal != goal_) since_ns_ = now_ns;
  const bool fell = state != state_ && height(state) < height(state_);
  state_ = state;
  known_ = is_standard(statusword);
  goal_ = goal;
  if (turns_up) {
    left_fault_ = false;
    falls_ = 0;
  } else if (fell && !reached() && !falls_back()) {
    ++falls_;
  }
  left_fault_ = left_fault_ || !is_fault(state);
  late_ = !reached() && now_ns - since_ns_ > limit_ns();
  return goal == Goal::kDisabled ? stop_word() : enable_word(now_ns);
}

bool DriveMachine::reached() const {
  switch (goal_) {
    case Goal::kSwitchedOn: return state_ == State::kSwitchedOn;
    case Goal::kOperationEnabled: return state_ == State::kOperationEnabled;
    case Goal::kDisabled: break;
  }
  return known_ && (state_ == State::kSwitchOnDisabled || state_ == State::kFault ||
                    state_ == State::kNotReadyToSwitchOn);
}

bool DriveMachine::faulted() const {
  return goal_ != Goal::kDisabled && left_fault_ && is_fault(state_);
}

std::int64_t DriveMachine::limit_ns() const {
  if (goal_ == Goal::kDisabled) return times_.stop_ns;
  return state_ == State::kFault ? times_.reset_ns : times_.step_ns;
}

/// Quick stop from every state with power; a state that is off gets a word that leaves it there.
std::uint16_t DriveMachine::stop_word() const {
  return reached() || late_ ? kDisableVoltage : kQuickStop;
}

std::uint16_t DriveMachine::enable_word(std::int64_t now_ns) const {
  switch (state_) {
    case State::kSwitchOnDisabled: return kShutdown;
    case State::kReadyToSwitchOn: return kSwitchOn;
    case State::kSwitchedOn:
    case State::kOperationEnabled:
      return goal_ == Goal::kOperationEnabled ? kEnableOperation : kSwitchOn;
    case State::kFault:
      return (now_ns - since_ns_) / kHalfPulse_ns % 2 == 0 ? kFaultReset : kDisableVoltage;
    case State::kNotReadyToSwitchOn:
    case State::kFaultReactionActive:
    case State::kQuickStopActive: break;
  }
  return kDisableVoltage;
}

}  // namespace tactus::cia402
