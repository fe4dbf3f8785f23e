// The members of Motion, for the file that instantiates it.
#pragma once

#include "kernel/reference/motion/motion.hpp"

#include <new>

#include "kernel/reference/motion/slope_bounds.hpp"

namespace tactus {

/// A path that decelerates at its limits can take seconds to stop on; it is left after this time.
inline constexpr double kLongestBrake_s = 0.5;

template <class Space>
void Motion<Space>::start(const Point& point, const Settings& settings) {
  new (this) Motion();
  settings_ = &settings;
  reference_ = point.at_rest();
  hold(reference_);
}

template <class Space>
void Motion<Space>::move_on(double dt_s) {
  time_s_ += dt_s;
  const Point last = reference_;
  leave_given_up();
  if (kStreams && streams(phase_)) {
    if constexpr (kStreams) move_stream(dt_s);
  } else if (phase_ == MotionPhase::kStopping) {
    reference_ = Space::come_to_rest(reference_, settings_->limits, dt_s);
    if (reference_.standing()) {
      hold(reference_);
      handle(MotionEvent::kAtRest);
    }
  } else {
    const MotionPhase was = phase_;
    const Point before = on_path() ? base_ : base_of_points(time_s_ - dt_s);
    if (phase_ == MotionPhase::kReaching) offset_ = Space::difference(reference_, before);
    base_ = on_path() ? base_of_path(dt_s) : base_of_points(time_s_);
    // A path keeps the limits by itself, and a held point does not move; a stream may break limits.
    const bool there = offset_.zero() && !streaming();
    reference_ = there ? base_
                       : Space::approach(reference_, offset_, before, base_, steps(),
                                         limits_to(before), dt_s);
    if (offset_.zero()) arrive(was);
  }
  Space::keep_sign(reference_, last);
  fade(dt_s);
}

/// Returns the limits on the way to the base, which was `base` in the last cycle.
template <class Space>
const typename Space::Limits& Motion<Space>::limits_to(const Point& base) {
  if constexpr (kStreams) {
    if (!on_path()) return streams_.approach.limits(reference_, base, settings_->limits);
  }
  return settings_->limits;
}

/// Returns the base if it is no path: the stream, or the point that is held.
template <class Space>
typename Space::Point Motion<Space>::base_of_points(double time_s) const {
  return streaming() ? stream_.target(time_s) : held_;
}

/// Moves the path one period ahead and returns its point. Holds the point where the path has ended,
/// or where it has come to rest after it was given up.
template <class Space>
typename Space::Point Motion<Space>::base_of_path(double dt_s) {
  const double rate = phase_ == MotionPhase::kPaused || given_up() ? 0.0 : rate_;
  law_.step(path_, rate, left_to_path<Space>(settings_->limits, offset_), dt_s);
  const Point point = path_.at(law_.s()).at_rate(law_.rate(), law_.slope());
  if (path_.ended(law_.s())) return end_path(point);
  braking_s_ += dt_s;
  if (phase_ == MotionPhase::kBraking && law_.standing()) return end_path(point);
  if (law_.standing() && rate_ > 0.0 && path_.open()) handle(MotionEvent::kDry);
  if (!law_.standing() && phase_ == MotionPhase::kStarving) handle(MotionEvent::kFed);
  return point;
}

/// Ends the path at `last`; the base is at rest from now on. A quintic may end with an
/// acceleration, which becomes an offset and is closed; that of a cubic and the velocity of a line
/// may step.
template <class Space>
typename Space::Point Motion<Space>::end_path(const Point& last) {
  const Point rest = last.at_rest();
  if (phase_ != MotionPhase::kLeaving) held_ = rest;
  if (path_.smooth()) offset_.ddx += Space::difference(last, rest).ddx;
  path_.leave();
  feed_beyond(last, held_, kFade_s);
  handle(MotionEvent::kEnd);
  return rest;
}

/// Handles the arrival of the reference at its base; `was` is the phase before. The end of a path
/// that was to be left for a point is no arrival at that point.
template <class Space>
void Motion<Space>::arrive(MotionPhase was) {
  if (phase_ == MotionPhase::kJoining) handle(MotionEvent::kJoined);
  if (phase_ == MotionPhase::kReaching && was != MotionPhase::kLeaving && base_.standing())
    handle(MotionEvent::kAtRest);
}

template <class Space>
void Motion<Space>::hold(const Point& point) {
  path_.leave();
  held_ = base_ = point;
  offset_ = {};
}

template <class Space>
void Motion<Space>::feed_beyond(const Point& fed, const Point& base, double fade_s) {
  effort_ = Space::effort_beyond(fed, base);
  fade_s_ = fade_s;
  faded_s_ = 0.0;
}

/// Adds what is left of the fading feed-forward, by the quintic from one to zero, at rest at both.
template <class Space>
void Motion<Space>::fade(double dt_s) {
  faded_s_ += dt_s;
  if (!(faded_s_ < fade_s_)) return;
  const double x = faded_s_ / fade_s_, y = 1.0 - x;
  Space::add_effort(reference_, effort_, y * y * y * (1.0 + 3.0 * x + 6.0 * x * x),
                    -30.0 * x * x * y * y / fade_s_);
}

template <class Space>
void Motion<Space>::forward(const Point& point) {
  const Point last = reference_;
  reference_ = point;
  Space::keep_sign(reference_, last);
  hold(reference_);
  stream_.clear();
  fade_s_ = 0.0;
  handle(MotionEvent::kPoint);
}

template <class Space>
void Motion<Space>::reach(const Point& point, double stamp_s) {
  const double sent_s = time_s_ - settings_->period_s;  // it was sent before this cycle
  if constexpr (kStreams) {
    if (!stream_.recent(sent_s)) streams_.approach.begin();
  }
  stream_.push(point, sent_s, stamp_s);
  held_ = point.stopped();
  if (can_leave()) return go();
  if (!given_up()) braking_s_ = 0.0;
  handle(MotionEvent::kLeave);
}

/// True if the motion may leave its path for a stop. A path, and braking on it, stay inside limits;
/// a straight stop from it need not. A reference with an offset from its path can always stop.
template <class Space>
bool Motion<Space>::can_leave() const {
  return !on_path() || !offset_.zero() ||
         Space::can_stop(reference_, settings_->limits, settings_->period_s);
}

/// Leaves a path that was given up: for a point as soon as a stop stays inside limits, and in any
/// case after kLongestBrake_s.
template <class Space>
void Motion<Space>::leave_given_up() {
  const bool lost = braking_s_ > kLongestBrake_s;
  if (phase_ == MotionPhase::kLeaving && (lost || can_leave())) {
    lost_path_ = lost;
    go();
  } else if (phase_ == MotionPhase::kBraking && lost) {
    lost_path_ = true;
    stop();
  }
}

/// Goes to the held point, or along with the stream.
template <class Space>
void Motion<Space>::go() {
  path_.leave();
  feed_beyond(reference_, held_, stream_.moves(time_s_) ? stream_.period_s() : kFade_s);
  handle(MotionEvent::kPoint);
}

template <class Space>
void Motion<Space>::stop() {
  const Point rest = reference_.at_rest();
  feed_beyond(reference_, rest, kFade_s);
  if (reference_.standing()) hold(rest);
  path_.leave();
  handle(MotionEvent::kStop);
}

template <class Space>
void Motion<Space>::cancel() {
  if (phase_ == MotionPhase::kReaching || streams(phase_) || holds_effort() || !offset_.zero())
    return stop();
  if (!given_up()) braking_s_ = 0.0;
  handle(MotionEvent::kCancel);
}

template <class Space>
void Motion<Space>::pause(bool on) {
  paused_ = on;
  handle(on ? MotionEvent::kPause : MotionEvent::kResume);
}

template <class Space>
Verdict Motion<Space>::follow(const Trajectory<Space>& trajectory,
                              const typename Space::Tolerance& tolerance, const Point& measured,
                              double elapsed_s) {
  if (!can_leave()) return {Status::kCannotLeave};
  Path<Space> path(trajectory, reference_, settings_->limits);
  Verdict verdict = path.judge_placement(*settings_);
  Point base;
  if (verdict.ok()) verdict = enter(path, tolerance, measured, elapsed_s, base);
  if (!verdict.ok()) return verdict;
  // Out of a motion the path is met at full rate; from rest it is met at any rate.
  const double rate = !reference_.standing() ? 1.0 : paused_ ? 0.0 : rate_;
  path_ = path;
  law_.start(path_, elapsed_s, rate, Space::peaks(settings_->limits), settings_->period_s);
  stream_.clear();
  base_ = base.at_rate(law_.rate(), 0.0);
  offset_ = Space::difference(reference_, base_);
  feed_beyond(reference_, base_, kFade_s);
  lost_path_ = false;
  handle(MotionEvent::kTrajectory);
  if (paused_) handle(MotionEvent::kPause);
  return {};
}

/// Enters the path by a segment to its first waypoint, if that is still ahead: a segment that
/// continues the motion, or, if that is not known to keep all limits, one from where the motion
/// comes to rest. Else enters the path where it is now. The first waypoint may be near the measured
/// point, where planners begin, instead of near the reference.
/// `base` becomes the point at which the path is entered.
template <class Space>
Verdict Motion<Space>::enter(Path<Space>& path, const typename Space::Tolerance& tolerance,
                             const Point& measured, double elapsed_s, Point& base) const {
  if (path.first_s() > elapsed_s) {
    const bool stands = reference_.standing();
    Verdict verdict;
    if (stands || !path.join_from(reference_, elapsed_s, *settings_, Accuracy::kQuick).ok()) {
      const Point rest = stands ? reference_ : Space::rest_of(reference_, settings_->limits);
      verdict = path.join_from(rest, elapsed_s, *settings_, Accuracy::kClose);
    }
    base = path.begin();
    return verdict;
  }
  path.enter(elapsed_s);
  base = elapsed_s > path.first_s() ? path.at(elapsed_s) : path.begin();
  if (elapsed_s > 0.0) return {};
  Verdict verdict = Space::judge_near(base, reference_, tolerance);
  if (Space::judge_near(base, measured, tolerance).ok()) verdict = {};
  verdict.waypoint = 0;
  return verdict;
}

}  // namespace tactus
