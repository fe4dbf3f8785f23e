#include "kernel/streams/motion_streams.hpp"

#include <algorithm>

#include "kernel/reference/motion/motion_members.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

#if TACTUS_CHUNK_TARGETS > 0
namespace tactus {

template <class Space>
void Motion<Space>::approach_at(double speed) {
  streams_.approach.start(settings_->limits, speed);
}

template <class Space>
Verdict Motion<Space>::track(ChunkCurve<Space>& chunk, double now_s) {
  if (!can_leave()) return {Status::kCannotLeave};
  begin_stream(MotionEvent::kChunk);
  streams_.plan.install(chunk, Space::latch(chunk.header, reference_, settings_->limits),
                        time_s_ - now_s, time_s_);
  return {};
}

template <class Space>
Verdict Motion<Space>::drive(const Velocity<Space>& velocity) {
  if (!can_leave()) return {Status::kCannotLeave};
  begin_stream(MotionEvent::kVelocity);
  streams_.plan.clear();
  streams_.velocity = velocity;
  streams_.velocity_until_s = time_s_ + velocity.timeout_s;
  return {};
}

/// Leaves what the reference followed; its feed-forward fades.
template <class Space>
void Motion<Space>::begin_stream(MotionEvent event) {
  if (!streams(phase_)) {
    if (!stream_.recent(time_s_)) streams_.approach.begin();
    feed_beyond(reference_, reference_.at_rest(), kFade_s);
    path_.leave();
    stream_.clear();
  }
  handle(event);
}

/// The base has no limits of its own, so it is approached even where the reference is on it.
template <class Space>
void Motion<Space>::move_stream(double dt_s) {
  if (phase_ == MotionPhase::kDriving) return move_at_velocity(dt_s);
  const typename Space::Limits& limits = settings_->limits;
  const bool seam = streams_.plan.due(time_s_), stops = !seam && streams_.plan.runs_out(time_s_);
  const bool fades = !streams_.approach.on();
  if (seam) base_ = streams_.plan.enter(time_s_ - dt_s, time_s_, reference_, limits, fades);
  if (stops) base_ = streams_.plan.stop(time_s_ - dt_s, base_, reference_, limits, fades);
  if (seam || stops) offset_ = Space::difference(reference_, base_);
  if (seam) handle(MotionEvent::kChunk);
  const Point before = base_;
  base_ = streams_.plan.move_on(time_s_);
  streams_.plan.pass_outputs(time_s_);
  const typename Space::Limits& own = limits_to(before);
  const bool moves = !(before.standing() && base_.standing());
  reference_ = Space::approach(reference_, offset_, before, base_, false,
                               moves ? streams_.plan.beside(own) : own, dt_s);
  if (offset_.zero()) streams_.plan.join();
  if (streams_.plan.stopping()) handle(MotionEvent::kExpire);
  if (offset_.zero() && streams_.plan.ended(time_s_) && reference_.standing()) rest_from_stream();
}

template <class Space>
void Motion<Space>::move_at_velocity(double dt_s) {
  const bool valid = time_s_ <= streams_.velocity_until_s;
  const typename Space::Rates none = 0.0 * streams_.velocity.rates;
  const typename Space::Rates rates = streams_.velocity.in_tool
                                          ? Space::in_base(streams_.velocity.rates, reference_)
                                          : streams_.velocity.rates;
  reference_ = Space::go_at(reference_, valid ? rates : none, settings_->limits,
                            streams_.velocity.acceleration, streams_.velocity.jerk, dt_s);
  if (reference_.standing() && (!valid || rates == none)) rest_from_stream();
}

template <class Space>
void Motion<Space>::rest_from_stream() {
  hold(reference_.at_rest());
  handle(MotionEvent::kAtRest);
}

template <class Space>
const ChunkPlan<Space>& Motion<Space>::plan() const {
  return streams_.plan;
}

template <class Space>
bool Motion<Space>::expires() const {
  return phase_ == MotionPhase::kExpiring ||
         (phase_ == MotionPhase::kDriving && time_s_ > streams_.velocity_until_s);
}

template <class Space>
double Motion<Space>::margin_s() const {
  if (phase_ == MotionPhase::kTracking) return streams_.plan.margin_s(time_s_);
  return phase_ == MotionPhase::kDriving ? std::max(streams_.velocity_until_s - time_s_, 0.0) : 0.0;
}

template <class Space>
PassedInPeriod Motion<Space>::take_outputs() {
  return streams_.plan.take_outputs();
}

template class Motion<JointSpace>;
template class Motion<TaskSpace>;

}  // namespace tactus
#endif
