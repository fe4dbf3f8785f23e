// OutputDelay: delays digital outputs from the targets that request them to the time at which they
// are due. They stay until the next change is due.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/core/digital_outputs.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/motion/time_rounding.hpp"

namespace tactus {

class OutputDelay {
 public:
  /// Most pending changes. With more, the one before the newest is lost; the last state is not.
  static constexpr std::size_t kMostWaiting = 32;

  /// Requests outputs from `due_s` on. Changes that were due later take effect with them, at
  /// `due_s`; an output that both set follows this request. [cyclic]
  void request(const DigitalOutputs& outputs, double due_s) {
    requested_.set(outputs);
    LoopBound<kMostWaiting> later;
    while (count_ > 0 && at(count_ - 1).due_s >= due_s) {
      later.tick();
      --count_;
    }
    if (requested_ == (count_ > 0 ? at(count_ - 1).outputs : active_)) return;
    if (count_ == kMostWaiting) --count_;
    at(count_++) = {due_s, requested_};
  }
  /// Drops all pending changes. [cyclic]
  void hold() {
    count_ = 0;
    requested_ = active_;
  }
  /// Makes the changes that are due at `now_s`. [cyclic]
  void move_on(double now_s) {
    LoopBound<kMostWaiting> due;
    while (count_ > 0 && at(0).due_s <= now_s + kTimeRounding_s) {
      due.tick();
      active_ = at(0).outputs;
      first_ = (first_ + 1) % kMostWaiting;
      --count_;
    }
  }
  const DigitalOutputs& active() const { return active_; }
  /// True if changes are pending.
  bool waits() const { return count_ > 0; }

 private:
  struct Change {
    double due_s = 0.0;
    DigitalOutputs outputs;  // all outputs commanded from then on
  };
  Change& at(std::size_t i) { return changes_[(first_ + i) % kMostWaiting]; }

  std::array<Change, kMostWaiting> changes_;
  std::size_t first_ = 0, count_ = 0;
  DigitalOutputs requested_, active_;
};

}  // namespace tactus
