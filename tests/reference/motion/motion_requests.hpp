// RandomClient: a client that requests anything at any time, with a robot and an executive that act
// at random too.
#pragma once

#include <cstdio>

#include "tests/reference/motion/motion_oracle.hpp"
#include "tests/reference/motion/motion_streams.hpp"

namespace tactus {

template <class Space>
class RandomClient {
 public:
  using Cases = MotionCases<Space>;
  using Point = typename Space::Point;

  RandomClient(MotionBench<Space>& bench, MotionAccounts& accounts, Dice& dice,
               Smoothness smoothness)
      : bench_(bench), accounts_(accounts), dice_(dice), smoothness_(smoothness) {
    accounts_.open();
    listening_ = dice.chance(0.5) ? 1.0 : dice.chance(0.5) ? 0.05 : 0.005;
  }

  /// Makes one random request.
  void ask() {
    ++asked_;
    const int kind = dice_.below(100);
    if (kind < 30) return send_trajectory(false);
    if (kind < 42) return send_trajectory(true);
    if (kind < 54) return send_point();
    if (kind < 62) return begin_stream();
    if (kind < 70) return other("cancel", bench_.cancel());
    if (kind < 78) return send_override();
    if (kind < 88) return pause_or_resume();
    if (kind < 92) return scale();
    if (kind < 95) return stray();
    if (kind < 97) return brake_for(1 + dice_.below(bench_.cycles(0.3)));
    return nonsense();
  }
  /// Steps everything by one cycle; false if the generator reports a fault.
  bool step() {
    stream_.step(dice_, bench_, accounts_);
    feeder_.step(dice_, bench_, accounts_);
    bench_.generator.scale_speed(scaling_);
    const bool follows = bench_.generator.time_s() >= stray_until_s_;
    const Status status =
        bench_.step(follows ? bench_.out() : Cases::displaced(dice_, bench_.out(), stray_));
    if (braking_ > 0) bench_.brake(Status::kCollision);
    if (dice_.chance(listening_)) listen();
    return status == Status::kOk;
  }
  /// Counts down the braking; at its end starts the generator at the present reference and returns
  /// true.
  bool restarted() {
    if (braking_ == 0 || --braking_ > 0) return false;
    scaling_ = 1.0;
    const Point now = bench_.out();
    static_cast<void>(bench_.start(now));
    return true;
  }
  /// The executive brakes for this number of cycles.
  void brake_for(int cycles) {
    braking_ = cycles;
    note("the executive brakes for %d cycles", cycles);
  }
  /// Ends all activity of its own and fetches every report from now on.
  void calm_down() {
    stream_.end();
    feeder_.end();
    braking_ = std::min(braking_, 1);
    stray_until_s_ = 0.0;
    scaling_ = 1.0;
    listening_ = 1.0;
  }
  /// Cancels whatever runs.
  void finish() { other("cancel", bench_.cancel()); }
  void listen() {
    Report report;
    while (bench_.client.poll(report)) accounts_.told(report);
  }

  int asked() const { return asked_; }
  /// Prints the last requests, the newest first.
  void print_log() const {
    for (std::size_t i = 0; i < log_.size(); ++i) {
      const std::size_t entry = (newest_ + log_.size() - i) % log_.size();
      if (log_[entry][0] != '\0') std::printf("    %s\n", log_[entry].data());
    }
  }

 private:
  template <class... Values>
  void note(const char* format, Values... values) {
    newest_ = (newest_ + 1) % log_.size();
    const int length = std::snprintf(log_[newest_].data(), log_[newest_].size(),
                                     "%9.4f s: ", bench_.generator.time_s());
    const std::size_t from = static_cast<std::size_t>(std::max(length, 0));
    std::snprintf(log_[newest_].data() + from, log_[newest_].size() - from, format, values...);
  }
  void other(const char* what, std::uint32_t id) {
    if (id != 0) accounts_.sent(id, Asked::kOther);
    note("%s: %u", what, id);
  }

  void send_point() {
    const typename Space::Limits& limits = bench_.channel.settings.limits;
    Point point = Cases::somewhere(dice_, limits, bench_.out(), dice_.uniform(0.0, 1.5));
    if (dice_.chance(0.15)) point = bench_.out().at_rest();
    if (dice_.chance(0.3)) Cases::set_feed_forward(dice_, limits, point);
    std::uint32_t id = 0;
    const typename Space::Header header =
        dice_.chance(0.2) ? Cases::header(dice_) : typename Space::Header();
    if (bench_.client.send(point, id, header).ok()) accounts_.sent(id, Asked::kPoint);
    accounts_.not_sent(id == 0, Asked::kPoint);
    note("point: %u", id);
  }
  void begin_stream() {
    stream_.begin(dice_, bench_);
    note("stream: %s, every %g s", stream_.name(), stream_.period_s());
  }
  void send_override() {
    const double rate = dice_.chance(0.6) ? 1.0 : dice_.chance(0.4) ? 0.0 : dice_.uniform(0.0, 1.0);
    other("override", bench_.set_override(rate));
    note("  of %.3f", rate);
  }
  void pause_or_resume() {
    std::uint32_t id = 0;
    const bool pauses = dice_.chance(0.25);
    const Verdict verdict = pauses ? bench_.client.pause(id) : bench_.client.resume(id);
    other(pauses ? "pause" : "resume", verdict.ok() ? id : 0);
  }
  void scale() {
    scaling_ = dice_.chance(0.6) ? 1.0 : dice_.chance(0.2) ? 0.0 : dice_.uniform(0.0, 1.0);
    note("robot passes motions at %.3f", scaling_);
  }
  void stray() {
    stray_ = dice_.chance(0.5) ? 0.02 : 0.3;
    stray_until_s_ = bench_.generator.time_s() + dice_.uniform(0.0, 0.2);
    note("robot strays by %g", stray_);
  }
  void nonsense() {
    Point point = bench_.out();
    Cases::scale_rates(point, std::nan(""));
    note("not a number: %u", bench_.send(point));
  }

  void send_trajectory(bool open) {
    const bool lines = smoothness_ == Smoothness::kPosition && dice_.chance(0.7);
    const bool cubics = smoothness_ != Smoothness::kAcceleration && dice_.chance(0.7);
    const Fields fields = lines    ? Fields{0}
                          : cubics ? Fields{kVelocityField}
                                   : Fields{kVelocityField | kAccelerationField};
    Trajectory<Space>* motion = bench_.trajectory(fields);
    if (motion == nullptr) return note("no store");  // not asked
    if (cubics && !lines && !open && dice_.chance(0.3))
      motion->interpolation = Interpolation::kMonotone;
    fill(*motion, open);
    if (dice_.chance(0.15)) motion->header = Cases::header(dice_);
    if (dice_.chance(0.3)) Cases::set_path_tolerance(motion->tolerances.path, 0.05);
    const double now_s = bench_.generator.time_s();
    if (dice_.chance(0.2)) motion->start_s = now_s + dice_.uniform(0.0, 0.5);
    if (dice_.chance(0.15)) motion->start_s = now_s - dice_.uniform(0.0, 0.7) * motion->end_s();
    const std::uint32_t id = fit(*motion) ? bench_.send(*motion) : 0;
    const int store = static_cast<int>(motion - bench_.channel.stores.data());
    if (id != 0) accounts_.sent(id, Asked::kTrajectory, store);
    accounts_.not_sent(id == 0, Asked::kTrajectory);
    if (id != 0 && open) feeder_.begin(dice_, *motion, now_s);
    note("%s trajectory of %d, fields %d, %.3f..%.3f s, start %+.3f s: %u",
         open ? "open" : "closed", motion->count, fields, motion->at(0).time_s, motion->end_s(),
         motion->start_s - now_s, id);
  }
  /// Fills in waypoints anywhere, with times about as short as the limits allow.
  void fill(Trajectory<Space>& motion, bool open) {
    const typename Space::Limits& limits = bench_.channel.settings.limits;
    const double reach = dice_.uniform(0.0, 1.2), share = dice_.uniform(0.0, 1.0);
    const int count = 1 + dice_.below(6);
    motion.open = open;
    Point from = bench_.out();
    double time_s = 0.0;
    if (dice_.chance(0.25)) {  // at t = 0: where the reference is about to be, moving or not
      Point begin = dice_.chance(0.5) ? from.at_rest() : from;
      if (dice_.chance(0.5)) begin = Cases::displaced(dice_, begin, dice_.uniform(0.0, 0.004));
      bench_.add(motion, 0.0, begin);
    }
    for (int i = 0; i < count; ++i) {
      Point to = Cases::somewhere(dice_, limits, from.at_rest(), reach);
      if (i + 1 < count || open) Cases::set_moving(dice_, limits, share, to);
      if (dice_.chance(0.2)) Cases::set_feed_forward(dice_, limits, to);
      const double slack = i == 0 ? dice_.uniform(1.0, 1.6) : dice_.uniform(0.5, 1.2);
      time_s += slack * connecting_time_s<Space>(from, to, limits) + bench_.period_s;
      bench_.add(motion, time_s, to);
      from = to;
    }
  }
  /// Changes a motion until it is admitted: gives it more time, or, if it swings out of range,
  /// lower velocities at its waypoints. False if it cannot be admitted.
  bool fit(Trajectory<Space>& motion) {
    constexpr double kMore = 1.12, kSlower = 0.5;
    for (int i = 0; i < 30; ++i) {
      const Status status = bench_.client.admit(motion).status;
      if (status == Status::kOk) return true;
      if (status == Status::kReferenceNotFinite) return false;
      const bool outside = status == Tracks<Space>::kOutside;
      for (int k = 0; k < motion.count; ++k) {
        motion.waypoints[k].time_s *= outside ? 1.0 : kMore;
        Cases::scale_rates(motion.waypoints[k].point, outside ? kSlower : 1.0 / kMore);
      }
    }
    return false;
  }

  MotionBench<Space>& bench_;
  MotionAccounts& accounts_;
  Dice& dice_;
  Smoothness smoothness_;
  SentStream<Space> stream_;
  Feeder<Space> feeder_;
  double listening_ = 1.0, scaling_ = 1.0, stray_ = 0.0, stray_until_s_ = 0.0;
  int braking_ = 0, asked_ = 0;
  std::array<std::array<char, 120>, 12> log_{};
  std::size_t newest_ = 0;
};

}  // namespace tactus
