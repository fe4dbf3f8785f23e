#include "kernel/reference/motion.hpp"

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

/// What was fed forward goes in this time, or in that between two points of a stream.
constexpr double kFade_s = 0.1;
/// A path that brakes at its limits all along can take seconds to be stopped on: it is left then.
constexpr double kLongestBrake_s = 0.5;

}  // namespace

template <class Space>
void Motion<Space>::start(const Point& point, const Settings& settings) {
  *this = Motion();
  settings_ = &settings;
  reference_ = point.at_rest();
  hold(reference_);
}

template <class Space>
void Motion<Space>::move_on(double dt_s) {
  time_s_ += dt_s;
  if (phase_ == Phase::kStopping) {
    reference_ = Space::come_to_rest(reference_, settings_->limits, dt_s);
    if (reference_.standing()) hold(reference_), tell(MotionEvent::kAtRest);
  } else {
    const Point before = on_path() ? base_ : base_of_points(time_s_ - dt_s);
    base_ = on_path() ? base_of_path(dt_s) : base_of_points(time_s_);
    if (phase_ == Phase::kReaching) offset_ = Space::difference(reference_, before);
    // A path is within limits by itself, and what is held is put out as it is; a stream is neither.
    const bool there = offset_.zero() && !streaming();
    reference_ = there ? base_
                       : Space::approach(reference_, offset_, before, base_, steps(),
                                         settings_->limits, dt_s);
    settle();
  }
  fade(dt_s);
}

/// Whatever is no path: a stream, or what is held.
template <class Space>
typename Space::Point Motion<Space>::base_of_points(double time_s) const {
  return streaming() ? stream_.target(time_s) : held_;
}

/// The path one period on; held where it has ended, or rests when it is given up.
template <class Space>
typename Space::Point Motion<Space>::base_of_path(double dt_s) {
  const bool stands = phase_ == Phase::kPaused || phase_ == Phase::kBraking;
  law_.step(path_, stands ? 0.0 : rate_, Space::left_to_path(settings_->limits, offset_), dt_s);
  const Point point = path_.at(law_.s()).at_rate(law_.rate(), law_.slope());
  if (path_.ended(law_.s())) return end_path(point);
  braking_s_ += dt_s;
  if (phase_ == Phase::kBraking && law_.standing()) return end_path(point);
  if (phase_ == Phase::kBraking && braking_s_ > kLongestBrake_s)
    return lost_path_ = true, stop(), point;
  if (law_.standing() && rate_ > 0.0 && path_.open()) tell(MotionEvent::kDry);
  if (!law_.standing() && phase_ == Phase::kStarving) tell(MotionEvent::kFed);
  return point;
}

/// From `last` on nothing moves the base. Quintics may end with an acceleration, which the
/// reference then runs out; that of a cubic and the velocity of a line step by nature.
template <class Space>
typename Space::Point Motion<Space>::end_path(const Point& last) {
  const Point rest = last.at_rest();
  if (path_.smooth()) offset_.ddx += Space::difference(last, rest).ddx;
  path_.leave();
  feed_beyond(last, rest, kFade_s);
  held_ = rest;
  tell(MotionEvent::kEnd);
  return rest;
}

template <class Space>
void Motion<Space>::settle() {
  if (!offset_.zero()) return;
  if (phase_ == Phase::kJoining) tell(MotionEvent::kJoined);
  if (phase_ == Phase::kReaching && base_.standing()) tell(MotionEvent::kAtRest);
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

/// The quintic from one to zero that begins and ends at rest.
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
  reference_ = point;
  hold(point);
  stream_.clear();
  fade_s_ = 0.0;
  tell(MotionEvent::kPoint);
}

template <class Space>
void Motion<Space>::reach(const Point& point) {
  stream_.push(point, time_s_ - settings_->period_s);  // it was sent before this cycle
  path_.leave();
  held_ = point.stopped();
  feed_beyond(reference_, held_, stream_.moves(time_s_) ? stream_.period_s() : kFade_s);
  tell(MotionEvent::kPoint);
}

template <class Space>
void Motion<Space>::stop() {
  const Point rest = reference_.at_rest();
  feed_beyond(reference_, rest, kFade_s);
  if (reference_.standing()) hold(rest);
  path_.leave();
  tell(MotionEvent::kStop);
}

template <class Space>
void Motion<Space>::cancel() {
  if (phase_ == Phase::kReaching || !offset_.zero()) return stop();
  if (phase_ != Phase::kBraking) braking_s_ = 0.0;
  tell(MotionEvent::kCancel);
}

template <class Space>
void Motion<Space>::pause(bool on) {
  paused_ = on;
  tell(on ? MotionEvent::kPause : MotionEvent::kResume);
}

template <class Space>
Verdict Motion<Space>::follow(const Trajectory<Space>& trajectory,
                              const typename Space::Tolerance& tolerance, const Point& measured,
                              double elapsed_s) {
  Path<Space> path(trajectory, reference_, settings_->limits);
  Verdict verdict = path.judge_terms(*settings_);
  if (verdict.ok()) verdict = enter(path, tolerance, measured, elapsed_s);
  if (!verdict.ok()) return verdict;
  // Out of a motion the path is met at full rate; from rest any rate meets it.
  const double rate = !reference_.standing() ? 1.0 : paused_ ? 0.0 : rate_;
  path_ = path;
  law_.start(path_, elapsed_s, rate, Space::peaks(settings_->limits), settings_->period_s);
  stream_.clear();
  const bool late = elapsed_s > path_.first_s();
  base_ = (late ? path_.at(elapsed_s) : path_.begin()).at_rate(law_.rate(), 0.0);
  offset_ = Space::difference(reference_, base_);
  feed_beyond(reference_, base_, kFade_s);
  lost_path_ = false;
  tell(MotionEvent::kTrajectory);
  if (paused_) tell(MotionEvent::kPause);
  return {};
}

/// By a segment to its first waypoint, if that lies ahead: out of a motion by one that continues
/// it, or by one from where it can be stopped. Else where the path is by now. A planner's first
/// waypoint is where the robot is measured to be, from which the reference may be apart.
template <class Space>
Verdict Motion<Space>::enter(Path<Space>& path, const typename Space::Tolerance& tolerance,
                             const Point& measured, double elapsed_s) const {
  if (path.first_s() > elapsed_s) {
    const Verdict verdict = path.lead_in(reference_, elapsed_s, 0, *settings_);
    if (verdict.ok() || reference_.standing()) return verdict;
    const Point rest = Space::rest_of(reference_, settings_->limits);
    return path.lead_in(rest, elapsed_s, 0, *settings_).ok() ? Verdict() : verdict;
  }
  path.enter(elapsed_s);
  if (elapsed_s > 0.0) return {};
  Verdict verdict = Space::judge_near(path.begin(), reference_, tolerance);
  if (Space::judge_near(path.begin(), measured, tolerance).ok()) verdict = {};
  verdict.waypoint = 0;
  return verdict;
}

template <class Space>
Verdict Motion<Space>::extend(const typename Space::Use& more) {
  return path_.extend(more, *settings_);
}

template class Motion<JointSpace>;
template class Motion<TaskSpace>;

}  // namespace tactus
