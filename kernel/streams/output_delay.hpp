// OutputDelay: the digital outputs between the targets that ask for them and the robot. What is
// asked for is put out when it is due, and stays until something else is.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/core/digital_outputs.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/motion/time_rounding.hpp"

namespace tactus {

class OutputDelay {
 public:
  /// Changes that can wait. With more, the one before the newest is lost; the last state is not.
  static constexpr std::size_t kMostWaiting = 32;

  /// Asks for outputs from `due_s` on. What was to be put out later than that comes with them: the
  /// newest that was asked for wins. [cyclic]
  void ask(const DigitalOutputs& outputs, double due_s) {
    wanted_.set(outputs);
    LoopBound<kMostWaiting> later;
    while (count_ > 0 && at(count_ - 1).due_s >= due_s) {
      later.tick();
      --count_;
    }
    if (wanted_ == (count_ > 0 ? at(count_ - 1).outputs : put_out_)) return;
    if (count_ == kMostWaiting) --count_;
    at(count_++) = {due_s, wanted_};
  }
  /// Voids what is not yet put out. [cyclic]
  void hold() {
    count_ = 0;
    wanted_ = put_out_;
  }
  /// Puts out what is due at `now_s`. [cyclic]
  void move_on(double now_s) {
    LoopBound<kMostWaiting> due;
    while (count_ > 0 && at(0).due_s <= now_s + kTimeRounding_s) {
      due.tick();
      put_out_ = at(0).outputs;
      first_ = (first_ + 1) % kMostWaiting;
      --count_;
    }
  }
  const DigitalOutputs& put_out() const { return put_out_; }
  /// True if changes wait.
  bool waits() const { return count_ > 0; }

 private:
  struct Change {
    double due_s = 0.0;
    DigitalOutputs outputs;  // all that is commanded from then on
  };
  Change& at(std::size_t i) { return changes_[(first_ + i) % kMostWaiting]; }

  std::array<Change, kMostWaiting> changes_;
  std::size_t first_ = 0, count_ = 0;
  DigitalOutputs wanted_, put_out_;
};

}  // namespace tactus
