// SimDrives: the state machine of the simulated drives, which all change together. They take a
// number of cycles to become enabled and as many to become disabled, as drives on a bus do.
#pragma once

#include "kernel/core/drive.hpp"

namespace tactus {

class SimDrives {
 public:
  /// Begins with disabled drives. [init]
  void start(int cycles) {
    *this = {};
    cycles_ = cycles;
  }
  /// Takes one step towards what is requested. [cyclic]
  void step(DriveRequest request) {
    const bool wanted = request != DriveRequest::kDisable;
    if (state_ == DriveState::kEnabled && !wanted) begin(DriveState::kStopping);
    const bool disabled = state_ == DriveState::kDisabled || state_ == DriveState::kFault;
    if (disabled && request == DriveRequest::kArm) begin(DriveState::kArming);
    if (state_ == DriveState::kArming && !wanted) state_ = DriveState::kDisabled;
    const bool moves = state_ == DriveState::kArming || state_ == DriveState::kStopping;
    if (!moves || --left_ > 0) return;
    state_ = state_ == DriveState::kArming ? DriveState::kEnabled : DriveState::kDisabled;
  }
  void fail() { state_ = DriveState::kFault; }
  DriveState state() const { return state_; }

 private:
  void begin(DriveState state) {
    state_ = state;
    left_ = cycles_;
  }

  DriveState state_ = DriveState::kDisabled;
  int cycles_ = 0, left_ = 0;
};

}  // namespace tactus
