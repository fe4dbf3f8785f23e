// Motion: along the curves of chunks, and at a given velocity.
#include "kernel/reference/motion/motion.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

#if TACTUS_CHUNK_TARGETS > 0
namespace tactus {
template <class Space>
void Motion<Space>::approach_at(double speed) {
  streamed_.approach.start(settings_->limits, speed);
}

template <class Space>
Verdict Motion<Space>::track(ChunkCurve<Space>& chunk, double now_s) {
  if (!can_leave()) return {Status::kCannotLeave};
  begin_stream(MotionEvent::kChunk);
  plan_.install(chunk, Space::latch(chunk.header, reference_, settings_->limits), time_s_ - now_s,
                time_s_);
  return {};
}

template <class Space>
Verdict Motion<Space>::drive(const Velocity<Space>& velocity) {
  if (!can_leave()) return {Status::kCannotLeave};
  begin_stream(MotionEvent::kVelocity);
  plan_.clear();
  streamed_.velocity = velocity;
  velocity_until_s_ = time_s_ + velocity.timeout_s;
  return {};
}

/// Leaves what the reference followed; its feed-forward fades.
template <class Space>
void Motion<Space>::begin_stream(MotionEvent event) {
  if (!streams(phase_)) {
    if (!stream_.recent(time_s_)) streamed_.approach.begin();
    feed_beyond(reference_, reference_.at_rest(), kFade_s);
    path_.leave();
    stream_.clear();
  }
  tell(event);
}

/// The base has no limits of its own, so it is approached even where the reference is on it.
template <class Space>
void Motion<Space>::move_stream(double dt_s) {
  if (phase_ == Phase::kDriving) return move_at_velocity(dt_s);
  const typename Space::Limits& limits = settings_->limits;
  const bool seam = plan_.due(time_s_), stops = !seam && plan_.runs_out(time_s_);
  const bool fades = !streamed_.approach.on();
  if (seam) base_ = plan_.enter(time_s_ - dt_s, time_s_, reference_, limits, fades);
  if (stops) base_ = plan_.stop(time_s_ - dt_s, base_, reference_, limits, fades);
  if (seam || stops) offset_ = Space::difference(reference_, base_);
  if (seam) tell(MotionEvent::kChunk);
  const Point before = base_;
  base_ = plan_.move_on(time_s_);
  plan_.pass_outputs(time_s_);
  const typename Space::Limits& own = limits_to(before);
  const bool moves = !(before.standing() && base_.standing());
  reference_ = Space::approach(reference_, offset_, before, base_, false,
                               moves ? plan_.beside(own) : own, dt_s);
  if (offset_.zero()) plan_.join();
  if (plan_.stopping()) tell(MotionEvent::kExpire);
  if (offset_.zero() && plan_.ended(time_s_) && reference_.standing()) rest_from_stream();
}

template <class Space>
void Motion<Space>::move_at_velocity(double dt_s) {
  const bool valid = time_s_ <= velocity_until_s_;
  const typename Space::Rates none = 0.0 * streamed_.velocity.rates;
  const typename Space::Rates rates = streamed_.velocity.in_tool
                                          ? Space::in_base(streamed_.velocity.rates, reference_)
                                          : streamed_.velocity.rates;
  reference_ = Space::go_at(reference_, valid ? rates : none, settings_->limits,
                            streamed_.velocity.acceleration, streamed_.velocity.jerk, dt_s);
  if (reference_.standing() && (!valid || rates == none)) rest_from_stream();
}

template <class Space>
void Motion<Space>::rest_from_stream() {
  hold(reference_.at_rest());
  tell(MotionEvent::kAtRest);
}

template <class Space>
bool Motion<Space>::expires() const {
  return phase_ == Phase::kExpiring || (phase_ == Phase::kDriving && time_s_ > velocity_until_s_);
}

template <class Space>
double Motion<Space>::margin_s() const {
  if (phase_ == Phase::kTracking) return plan_.margin_s(time_s_);
  return phase_ == Phase::kDriving ? std::max(velocity_until_s_ - time_s_, 0.0) : 0.0;
}

template <class Space>
PassedInPeriod Motion<Space>::take_outputs() {
  return plan_.take_outputs();
}

#define TACTUS_MOTION_STREAMS(Space)                                 \
  template void Motion<Space>::approach_at(double);                  \
  template Verdict Motion<Space>::track(ChunkCurve<Space>&, double); \
  template Verdict Motion<Space>::drive(const Velocity<Space>&);     \
  template void Motion<Space>::move_stream(double);                  \
  template bool Motion<Space>::expires() const;                      \
  template PassedInPeriod Motion<Space>::take_outputs();             \
  template double Motion<Space>::margin_s() const
TACTUS_MOTION_STREAMS(JointSpace);
TACTUS_MOTION_STREAMS(TaskSpace);
#undef TACTUS_MOTION_STREAMS

}  // namespace tactus
#endif
