// StateHistory: where a robot was, commanded and measured, in the last seconds, from the messages
// of feedback. Relative targets are resolved against it outside the cycle.
#pragma once

#include <array>

#include "kernel/reference/generator/feedback.hpp"
#include "kernel/streams/chunk.hpp"

namespace tactus {

/// Time that is kept, s.
inline constexpr double kHistory_s = 2.0;

template <class Space>
class StateHistory {
 public:
  using Point = typename Space::Point;

  void push(const Feedback<Space>& feedback) {
    if (count_ > 0 && feedback.time_s <= newest().time_s) count_ = 0;  // the generator restarted
    // The newest is replaced by messages that follow too closely on the one before it.
    if (count_ < 2 || newest().time_s - at(1).time_s >= kSpacing_s) {
      newest_ = (newest_ + 1) % kStates;
      if (count_ < kStates) ++count_;
    }
    states_[newest_] = {feedback.time_s, feedback.desired.at_rest(), feedback.actual.at_rest()};
  }
  /// Finds the position at `time_s`, between two messages. False if that is before the oldest or
  /// after the newest one.
  bool find(double time_s, bool measured, Point& position) const {
    for (std::size_t age = 0; age < count_; ++age) {
      const State& state = at(age);
      if (state.time_s > time_s) continue;
      if (state.time_s == time_s) {
        position = measured ? state.actual : state.desired;
        return true;
      }
      if (age == 0) return false;
      const State& next = at(age - 1);
      const typename Space::Segment line(measured ? state.actual : state.desired,
                                         measured ? next.actual : next.desired,
                                         next.time_s - state.time_s, Interpolation::kLinear, 0);
      position = line.at(time_s - state.time_s).at_rest();
      return true;
    }
    return false;
  }

 private:
  struct State {
    double time_s = 0.0;
    Point desired, actual;
  };
  static constexpr std::size_t kStates = 256;
  static constexpr double kSpacing_s = 0.009;
  static_assert(kSpacing_s * (kStates - 2) > kHistory_s);

  const State& newest() const { return states_[newest_]; }
  const State& at(std::size_t age) const { return states_[(newest_ + kStates - age) % kStates]; }

  std::array<State, kStates> states_;
  std::size_t newest_ = 0, count_ = 0;
};

}  // namespace tactus
