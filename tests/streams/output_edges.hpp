// OutputEdges: the oracle of digital outputs: the edges of all chunks that were taken, as a list of
// times, for a motion that passes its curves at full rate. It knows nothing of plans.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace tactus {

class OutputEdges {
 public:
  /// One lead and one set of outputs for all chunks.
  void start(std::uint32_t mask, double lead_s, double period_s) {
    period_s_ = period_s;
    mask_ = mask;
    lead_s_ = lead_s;
    count_ = 0;
    value_ = seen_ = 0;
  }
  /// A chunk was taken in the cycle at `now_s`, and takes effect in the next: from its last target
  /// that has passed then it counts, or else from its first, and what older ones had for that cycle
  /// or later is void, and what they had for later stamps than this target's.
  template <class Stamp, class Value>
  void take(double now_s, int targets, Stamp stamp_s, Value value) {
    const double next_s = now_s + period_s_;
    int first = 0;
    while (first + 1 < targets && stamp_s(first + 1) <= next_s + 1e-9) ++first;
    const double effect = std::max(cycle_of(stamp_s(0)), std::ceil(next_s / period_s_ - 1e-6));
    int kept = 0;
    for (int i = 0; i < count_; ++i)
      if (edges_[index(i)].stamp_s < stamp_s(first) && cycle_of(edges_[index(i)].stamp_s) < effect)
        edges_[index(kept++)] = edges_[index(i)];
    count_ = kept;
    for (int i = first; i < targets; ++i) edges_[index(count_++)] = {stamp_s(i), value(i)};
  }
  /// The outputs of the cycle at `now_s`.
  void move_on(double now_s) {
    int done = 0;
    for (; done < count_ && edges_[index(done)].stamp_s - lead_s_ <= now_s + 1e-9; ++done) {
      value_ = edges_[index(done)].value & mask_;
      seen_ = mask_;
    }
    for (int i = done; i < count_; ++i) edges_[index(i - done)] = edges_[index(i)];
    count_ -= done;
  }
  std::uint32_t value() const { return value_; }
  std::uint32_t mask() const { return seen_; }

 private:
  struct Edge {
    double stamp_s = 0.0;
    std::uint32_t value = 0;
  };
  /// The cycle in which the outputs of a stamp are found: ahead of it by the lead.
  double cycle_of(double stamp_s) const {
    return std::ceil((stamp_s - std::max(lead_s_, 0.0) - 1e-9) / period_s_);
  }
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  std::array<Edge, 4096> edges_;
  int count_ = 0;
  std::uint32_t mask_ = 0, value_ = 0, seen_ = 0;
  double lead_s_ = 0.0, period_s_ = 1.0;
};

}  // namespace tactus
