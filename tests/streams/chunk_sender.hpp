// ChunkSender: a policy whose chunks overlap, disagree, and cross a network that delays, loses,
// repeats and reorders them.
#pragma once

#include "tests/reference/motion/motion_cases.hpp"

namespace tactus {

/// What a policy wants: a sum of sines on a line through the space, with an error of its own.
template <class Space>
struct Intent {
  typename Space::Point origin;
  typename MotionCases<Space>::Direction direction;
  double slow = 0.0, fast = 0.0, error = 0.0;

  static Intent random(Dice& dice, const typename Space::Limits& limits,
                       const typename Space::Point& from) {
    Intent intent;
    intent.origin = MotionCases<Space>::somewhere(dice, limits, from.at_rest(),
                                                  dice.chance(0.5) ? 0.0 : dice.uniform(0.0, 0.6));
    intent.direction = MotionCases<Space>::direction(dice, limits);
    intent.slow = dice.uniform(0.0, 0.7);
    intent.fast = dice.chance(0.3) ? dice.uniform(0.0, 0.3) : 0.0;
    return intent;
  }
  double s(double t) const { return slow * std::sin(1.3 * t) + fast * std::sin(7.0 * t) + error; }
  double ds(double t) const {
    return 1.3 * slow * std::cos(1.3 * t) + 7.0 * fast * std::cos(7.0 * t);
  }
  typename Space::Point at(const typename Space::Limits& limits, double t) const {
    return MotionCases<Space>::along(limits, origin, direction, s(t), ds(t));
  }
};

/// A chunk on its way: all that is needed to write it again.
template <class Space>
struct SentChunk {
  double arrival_s = 0.0, observed_s = 0.0, spacing_s = 0.0, noise = 0.0;
  int targets = 0;
  std::uint32_t epoch = 0, sequence = 0;
  std::uint64_t seed = 0;
  double fade_s = 0.0, smoothing_s = 0.0;
  bool ends = false, velocities = false;
  Intent<Space> intent;

  void write(Chunk<Space>& chunk, const typename Space::Limits& limits) const {
    Dice dice{seed};
    chunk.count = 0;
    chunk.epoch = epoch;
    chunk.sequence = sequence;
    chunk.fade_s = fade_s;
    chunk.smoothing_s = smoothing_s;
    chunk.ends = ends;
    chunk.velocities = velocities;
    for (int i = 0; i < targets; ++i) {
      const double t = observed_s + i * spacing_s;
      Intent<Space> noisy = intent;
      noisy.error += noise * dice.uniform(-1.0, 1.0);
      chunk.add(t, noisy.at(limits, t));
    }
  }
};

template <class Space>
class ChunkSender {
 public:
  explicit ChunkSender(Dice& dice) : dice_(dice) {
    every_s_ = dice.uniform(0.05, 0.5);
    spacing_s_ = dice.uniform(0.016, 0.1);
    targets_ = dice.chance(0.1) ? 1 : 2 + dice.below(60);
    latency_s_ = dice.uniform(0.0, 0.3);
    loss_ = dice.chance(0.5) ? 0.0 : dice.uniform(0.0, 0.4);
    repeats_ = dice.chance(0.5) ? 0.0 : 0.3;
    error_ = dice.chance(0.3) ? 0.0 : dice.uniform(0.0, 0.05);
    noise_ = dice.chance(0.5) ? 0.0 : 1e-3;
    fade_s_ = dice.chance(0.3) ? 0.0 : dice.uniform(0.02, kLongestFade_s);
    smoothing_s_ = dice.chance(0.5) ? 0.0 : dice.uniform(0.0, 0.05);
    velocities_ = dice.chance(0.2);
  }
  /// Makes the chunk that is due, if one is, for an arm at `now`.
  void observe(double now_s, const typename Space::Limits& limits,
               const typename Space::Point& now) {
    if (now_s < next_s_) return;
    next_s_ = now_s + every_s_;
    if (!has_intent_ || dice_.chance(0.1)) intent_ = Intent<Space>::random(dice_, limits, now);
    has_intent_ = true;
    SentChunk<Space> chunk;
    chunk.observed_s = now_s;
    chunk.spacing_s = spacing_s_;
    chunk.noise = noise_;
    chunk.targets = targets_;
    chunk.epoch = epoch_;
    chunk.sequence = ++sequence_;
    chunk.seed = dice_.bits();
    chunk.fade_s = fade_s_;
    chunk.smoothing_s = smoothing_s_;
    chunk.ends = dice_.chance(0.05);
    chunk.velocities = velocities_;
    chunk.intent = intent_;
    chunk.intent.error = error_ * dice_.uniform(-1.0, 1.0);
    if (!dice_.chance(loss_)) put(chunk, now_s);
    if (dice_.chance(repeats_)) put(chunk, now_s);
  }
  /// Takes a chunk that has arrived; false if none has.
  bool take(double now_s, SentChunk<Space>& chunk) {
    for (int i = 0; i < count_; ++i) {
      if (on_way_[static_cast<std::size_t>(i)].arrival_s > now_s) continue;
      chunk = on_way_[static_cast<std::size_t>(i)];
      on_way_[static_cast<std::size_t>(i)] = on_way_[static_cast<std::size_t>(--count_)];
      return true;
    }
    return false;
  }
  void begin_epoch(std::uint32_t least) {
    epoch_ = std::max(epoch_ + 1, least);
    sequence_ = 0;
  }
  /// The generator's clock begins again.
  void restart() {
    next_s_ = 0.0;
    count_ = 0;
  }

 private:
  void put(SentChunk<Space> chunk, double now_s) {
    chunk.arrival_s = now_s + latency_s_ * dice_.uniform(0.3, dice_.chance(0.1) ? 6.0 : 1.5);
    if (count_ < kMost) on_way_[static_cast<std::size_t>(count_++)] = chunk;
  }

  static constexpr int kMost = 64;
  Dice& dice_;
  double every_s_, spacing_s_, latency_s_, loss_, repeats_, error_, noise_, fade_s_, smoothing_s_;
  int targets_;
  bool velocities_, has_intent_ = false;
  double next_s_ = 0.0;
  std::uint32_t epoch_ = 1, sequence_ = 0;
  Intent<Space> intent_;
  std::array<SentChunk<Space>, kMost> on_way_;
  int count_ = 0;
};

}  // namespace tactus
