// The members of ReferenceGenerator that treat each kind of control and request.
#pragma once

#include <array>
#include <cassert>
#include <cmath>

#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/generator/reference_generator.hpp"
#include "kernel/reference/space/judge_channels.hpp"

namespace tactus {

template <class Space>
bool ReferenceGenerator<Space>::has_room() const {
  return channel_->reports.space() >= kReportsPerRequest + kControls;
}

/// Answers all controls, in every cycle before any request, so that nothing delays them.
template <class Space>
void ReferenceGenerator<Space>::take_controls() {
  Control control;
  LoopBound<kControls> controls;
  LoopBound<2> cancels;  // of a path that has ended, and of the way to its end; then nothing goes
  for (std::size_t i = 0; i < kControls; ++i) {
    controls.tick();
    if (!channel_->controls.take(control)) break;
    const Verdict verdict = answer(control, cancels);
    report(control.id, verdict.ok() ? Outcome::kExecuted : Outcome::kRefused, -1, verdict);
  }
}

template <class Space>
Verdict ReferenceGenerator<Space>::answer(const Control& control, LoopBound<2>& cancels) {
  if (void_controls_ > 0) {
    --void_controls_;
    return Verdict{Status::kNotStarted};
  }
  if (refusing_ != Status::kOk) return {refusing_};
  switch (control.kind) {
    case ControlKind::kCancel: return cancel(control.id, cancels);
    case ControlKind::kSlowDown:
      if (control.rate > override_) return {Status::kNotOwner};
      [[fallthrough]];
    case ControlKind::kOverride: return set_override(control.rate);
    case ControlKind::kPause:
    case ControlKind::kResume: break;
  }
  motion_.pause(control.kind == ControlKind::kPause);
  return {};
}

/// A stop voids what is on its way and what was sent before, and digital outputs stay as they are.
template <class Space>
void ReferenceGenerator<Space>::end_epoch() {
  motion_.forget_points();
  if constexpr (kStreams) {
    stream_.gate.end();
    channel_->stream.epoch = stream_.gate.least();
    stream_.outputs.hold();
  }
}

/// Cancels what runs, what waits, and what was sent before but not yet taken.
template <class Space>
Verdict ReferenceGenerator<Space>::cancel(std::uint32_t id, LoopBound<2>& cancels) {
  assert(refusing_ == Status::kOk);
  const bool switches = outputs_wait();
  end_epoch();
  const bool goes = running_.any() || waiting_.any() || phase() == MotionPhase::kReaching ||
                    streams(phase()) || phase() == MotionPhase::kLeaving || motion_.holds_effort();
  if (!goes && !switches && channel_->requests.size() == 0) return {Status::kNothingToCancel};
  canceled_before_ = id;
  end_waiting(Outcome::kCanceled);
  if (!goes) return {};
  cancels.tick();
  motion_.cancel();
  end_running(Outcome::kCanceled, !motion_.on_path());
  return {};
}

template <class Space>
Verdict ReferenceGenerator<Space>::set_override(double rate) {
  if (!(rate >= 0.0 && rate <= 1.0)) return {Status::kBadOverride, -1, -1, rate, 1.0};
  override_ = rate;
  motion_.set_rate(override_ * speed_scaling_);
  return {};
}

/// Answers requests. If several points follow each other, only the newest is judged and becomes the
/// reference, as in the paper; the others are reported as superseded. A point ends the requests of
/// this cycle, together with the request after it.
template <class Space>
void ReferenceGenerator<Space>::take_requests() {
  Request<Space> one, other;
  const Request<Space>* point = nullptr;
  LoopBound<kMostRequests> requests;
  for (std::size_t i = 0; i < channel_->requests.capacity(); ++i) {
    requests.tick();
    if (begun_ && refusing_ == Status::kOk) break;
    Request<Space>& request = point == &one ? other : one;
    if (!has_room() || !channel_->requests.take(request)) break;
    if (answered(request)) continue;
    if (request.kind != RequestKind::kPoint) {
      if (point != nullptr) take_point(*point);
      take_other(request);
      if (point != nullptr) return;
    } else {
      if (point != nullptr) report(point->id, Outcome::kSuperseded);
      point = &request;
    }
  }
  if (point != nullptr) take_point(*point);
}

template <class Space>
void ReferenceGenerator<Space>::take_other(const Request<Space>& request) {
  if constexpr (kStreams) {
    if (request.kind >= RequestKind::kChunk) return take_stream(request);
  }
  request.kind == RequestKind::kTrajectory ? take_trajectory(request) : take_append(request);
}

/// True if the request is answered whatever its kind: it was sent before the start or before the
/// last cancel, or the executive brakes.
template <class Space>
bool ReferenceGenerator<Space>::answered(const Request<Space>& request) {
  if (void_requests_ > 0) {
    --void_requests_;
    refuse(request, Status::kNotStarted);
    return true;
  }
  if (refusing_ != Status::kOk) {
    refuse(request, refusing_);
    return true;
  }
  return canceled(request);
}

/// Ends a point or a trajectory that was sent before the last cancel; true if it was. Numbers wrap
/// around.
template <class Space>
bool ReferenceGenerator<Space>::canceled(const Request<Space>& request) {
  const bool older = static_cast<std::int32_t>(canceled_before_ - request.id) > 0;
  if (!older || request.kind == RequestKind::kAppend) return false;
  const bool trajectory = request.kind == RequestKind::kTrajectory;
  if constexpr (kStreams) void_request(request);
  report(request.id, trajectory ? Outcome::kCanceled : Outcome::kSuperseded,
         trajectory ? request.store : -1);
  return true;
}

/// Refuses a request of any kind and returns the store that came with it.
template <class Space>
void ReferenceGenerator<Space>::refuse(const Request<Space>& request, Status why) {
  const bool carries_store = request.kind == RequestKind::kTrajectory;
  if constexpr (kStreams) void_request(request);
  report(request.id, Outcome::kRefused, carries_store ? request.store : -1, {why});
}

template <class Space>
Verdict ReferenceGenerator<Space>::judge_point(const Point& point) const {
  const typename Space::Limits& limits = channel_->settings.limits;
  const Verdict verdict = judge_online<Space>(point, limits);
  if constexpr (kStreams) {
    if (verdict.ok() && params_.bounds.max_step > 0.0)
      return judge_distance<Space>(reference(), point, params_.bounds.max_step);
  }
  return verdict;
}

/// Judges the step to a point in the mode that refuses steps. Only the first of several steps is
/// refused; points that follow it within kSlowest_s are not forwarded but approached within limits,
/// until the reference is at rest with them.
template <class Space>
Verdict ReferenceGenerator<Space>::judge_step(const Point& point, bool& forwards) {
  const Verdict verdict =
      judge_reach<Space>(reference(), point, channel_->settings.limits, period_s_);
  if constexpr (kStreams) {
    const bool follows = stream_.step_s > 0.0;
    const bool approaches = follows && stream_.approaches && phase() != MotionPhase::kHolding;
    forwards = verdict.ok() && !approaches;
    stream_.approaches = follows && !forwards;
    stream_.step_s = forwards ? 0.0 : kSlowest_s;
    if (follows) return {};
  }
  return verdict;
}

/// Returns true for the first of consecutive points beyond the end of a range.
template <class Space>
bool ReferenceGenerator<Space>::note_saturation(const Verdict& verdict) {
  bool reported = true;
  if constexpr (kStreams) {
    reported = stream_.saturates;
    stream_.saturates = !verdict.ok();
  }
  return !verdict.ok() && !reported;
}

/// Takes a point, which ends whatever ran before it: the paper's rule.
template <class Space>
void ReferenceGenerator<Space>::take_point(const Request<Space>& request) {
  assert(refusing_ == Status::kOk);
  const typename Space::Limits& limits = channel_->settings.limits;
  Point point = Space::placed(request.point, Space::latch(request.header, reference(), limits));
  Verdict saturation;
  if (kStreams && params_.online == OnlineMode::kLimit) saturation = Space::saturate(point, limits);
  bool forwards = params_.online != OnlineMode::kLimit;
  Verdict verdict = judge_point(point);
  if (verdict.ok() && params_.online == OnlineMode::kRefuse) verdict = judge_step(point, forwards);
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  double stamp_s = kNoStamp;
  if constexpr (kStreams) {
    stamp_s = request.details.stamp_s;
    if (request.details.sender != stream_.sender) motion_.forget_points();
    stream_.sender = request.details.sender;
  }
  forwards ? motion_.forward(point) : motion_.reach(point, stamp_s);
  end_running(Outcome::kAborted, !motion_.on_path());
  point_age_s_ = 0.0;
  if constexpr (kStreams) stream_.outputs.request(request.details.outputs, time_s());
  report(request.id, Outcome::kExecuted, -1, note_saturation(saturation) ? saturation : Verdict());
}

/// Begins a trajectory at once, lets it wait for its start time, or joins it late. A newer one
/// replaces one that waits.
template <class Space>
void ReferenceGenerator<Space>::take_trajectory(const Request<Space>& request) {
  assert(refusing_ == Status::kOk);
  const Goal goal = {request.id, request.store};
  const bool known = request.store >= 0 && request.store < kStores &&
                     request.store != running_.store && request.store != waiting_.store &&
                     request.store != braked_on_;
  if (!known || trajectory(goal).count < 1)
    return report(request.id, Outcome::kRefused, -1, {Status::kReferenceSize});
  const double start_s = trajectory(goal).start_s, elapsed_s = time_s() - start_s;
  const bool now = start_s == kStartAtOnce || std::abs(elapsed_s) <= 0.5 * period_s_;
  const double latest_s = time_s() + kLongestTrajectory_s;
  const double longest_s = trajectory(goal).joinable ? trajectory(goal).end_s() : 0.0;
  if (!now && !(start_s <= latest_s && elapsed_s < longest_s))
    return report(
        request.id, Outcome::kRefused, request.store,
        {Status::kReferenceTime, -1, -1, start_s, start_s < time_s() ? time_s() : latest_s});
  const bool later = !now && elapsed_s < 0.0;
  if (!later && !begin(goal, now ? 0.0 : elapsed_s)) return;
  end_waiting(Outcome::kSuperseded);
  if (!later) return;
  waiting_ = goal;
  report(request.id, Outcome::kScheduled);
}

/// Takes up waypoints that the client has appended to a trajectory that runs or waits.
template <class Space>
void ReferenceGenerator<Space>::take_append(const Request<Space>& request) {
  assert(refusing_ == Status::kOk);
  const bool runs = running_.any() && request.store == running_.store && motion_.on_path();
  const bool waits = waiting_.any() && request.store == waiting_.store;
  const Goal goal = {request.id, request.store};
  if (!(runs || waits) || !trajectory(goal).open || request.count < trajectory(goal).count)
    return report(request.id, Outcome::kRefused, -1, {Status::kNothingToExtend});
  const Verdict verdict = runs ? motion_.extend(request.extent) : Verdict();
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  trajectory(goal).count = request.count;
  channel_->known[static_cast<std::size_t>(request.store)].store(
      request.last ? -request.count : request.count, std::memory_order_release);
  trajectory(goal).open = !request.last;
  trajectory(goal).extent = Space::Extent::largest(trajectory(goal).extent, request.extent);
  report(request.id, Outcome::kExecuted);
}

}  // namespace tactus
