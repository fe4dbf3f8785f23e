// Clients that continue by themselves: one streams points, one feeds an open trajectory.
#pragma once

#include "tests/reference/motion/motion_accounts.hpp"
#include "tests/reference/motion/motion_cases.hpp"

namespace tactus {

/// Streams points at some rate, with or without jitter, along a signal or anywhere.
template <class Space>
class SentStream {
 public:
  using Cases = MotionCases<Space>;

  void begin(Dice& dice, MotionBench<Space>& bench) {
    static constexpr std::array<double, 6> kPeriods_s = {0.2, 0.033, 0.02, 0.008, 0.001, 0.0};
    const int rate = dice.below(6);
    period_s_ = kPeriods_s[static_cast<std::size_t>(rate)];
    jitter_s_ = rate == 1 ? 0.005 : 0.0;
    shape_ = dice.below(5);
    with_velocity_ = dice.chance(0.5);
    frequency_ = dice.uniform(0.2, 5.0);
    amplitude_ = dice.uniform(0.1, 1.0) / (shape_ < 3 ? frequency_ : 1.0);
    noise_ = dice.chance(0.3) ? 1e-4 : 0.0;
    origin_ = bench.out().at_rest();
    direction_ = Cases::direction(dice, bench.channel.settings.limits);
    begun_s_ = next_s_ = bench.generator.time_s();
    end_s_ = begun_s_ + dice.uniform(0.0, 1.5);
  }
  void end() { end_s_ = -1.0; }
  /// Sends a point if one is due.
  void step(Dice& dice, MotionBench<Space>& bench, MotionAccounts& accounts) {
    const double now_s = bench.generator.time_s();
    if (now_s > end_s_ || now_s < next_s_) return;
    next_s_ += period_s_ + dice.uniform(0.0, jitter_s_);
    const typename Space::Limits& limits = bench.channel.settings.limits;
    typename Space::Point point = at(dice, limits, now_s - begun_s_);
    const std::uint32_t id = bench.send(point);
    if (id != 0) accounts.sent(id, Asked::kPoint);
  }
  const char* name() const {
    static constexpr std::array<const char*, 5> kNames = {"sine", "sine", "ramp", "jumps", "still"};
    return kNames[static_cast<std::size_t>(shape_)];
  }
  double period_s() const { return period_s_; }

 private:
  typename Space::Point at(Dice& dice, const typename Space::Limits& limits, double t) const {
    if (shape_ == 3) return Cases::somewhere(dice, limits, origin_, 2.0 * amplitude_);
    const double w = 6.28 * frequency_, noise = noise_ * dice.uniform(-1.0, 1.0);
    const double s = shape_ == 4   ? 0.0
                     : shape_ == 2 ? amplitude_ * t
                                   : 0.16 * amplitude_ * std::sin(w * t);
    const double ds = shape_ == 4   ? 0.0
                      : shape_ == 2 ? amplitude_
                                    : 0.16 * amplitude_ * w * std::cos(w * t);
    return Cases::along(limits, origin_, direction_, s + noise, with_velocity_ ? ds : 0.0);
  }

  double period_s_ = 0.0, jitter_s_ = 0.0, frequency_ = 1.0, amplitude_ = 1.0, noise_ = 0.0;
  double begun_s_ = 0.0, next_s_ = 0.0, end_s_ = -1.0;
  int shape_ = 0;
  bool with_velocity_ = false;
  typename Space::Point origin_;
  typename Cases::Direction direction_;
};

/// Appends chunks to an open trajectory, in time or late, up to the last.
template <class Space>
class Feeder {
 public:
  using Cases = MotionCases<Space>;
  using Point = typename Space::Point;

  void begin(Dice& dice, Trajectory<Space>& trajectory, double now_s) {
    trajectory_ = &trajectory;
    end_ = trajectory.at(trajectory.count - 1);
    share_ = dice.uniform(0.0, 0.9);
    every_s_ = dice.uniform(0.005, 0.3);
    chunks_ = 1 + dice.below(12);
    next_s_ = now_s + dice.uniform(0.0, every_s_);
  }
  void end() { trajectory_ = nullptr; }

  void step(Dice& dice, MotionBench<Space>& bench, MotionAccounts& accounts) {
    if (trajectory_ == nullptr || bench.generator.time_s() < next_s_) return;
    next_s_ += dice.chance(0.2) ? 5.0 * every_s_ : every_s_;
    const bool last = --chunks_ <= 0;
    for (int i = dice.below(5); i > 0; --i) append(dice, bench, false);
    if (last && !append(dice, bench, true)) chunks_ = 1;
    std::uint32_t id = 0;
    if (bench.client.flush(*trajectory_, last, id).ok()) {
      accounts.sent(id, Asked::kOther);
      if (last) end();
    } else if (dice.chance(0.1)) {
      end();  // given up; it starves
    }
  }

 private:
  /// Appends one more waypoint, as soon after the previous one as is admitted.
  bool append(Dice& dice, MotionBench<Space>& bench, bool rest) {
    const typename Space::Limits& limits = bench.channel.settings.limits;
    const Point to = Cases::somewhere(dice, limits, end_.point.at_rest(), dice.uniform(0.0, 0.2));
    Waypoint<Space> next = {0.0, to};
    if (!rest) Cases::set_moving(dice, limits, share_, next.point);
    double T = connecting_time_s<Space>(end_.point, next.point, limits) + bench.period_s;
    for (int i = 0; i < 12; ++i, T *= 1.3) {
      next.time_s = end_.time_s + T;
      const Verdict verdict = bench.client.append(*trajectory_, next);
      if (verdict.ok()) {
        end_ = next;
        return true;
      }
      if (verdict.status == Status::kWindowFull || verdict.status == Status::kNothingToExtend)
        break;
      Cases::scale_rates(next.point, 0.7);
    }
    return false;
  }

  Trajectory<Space>* trajectory_ = nullptr;
  Waypoint<Space> end_;
  double share_ = 0.0, every_s_ = 0.0, next_s_ = 0.0;
  int chunks_ = 0;
};

}  // namespace tactus
