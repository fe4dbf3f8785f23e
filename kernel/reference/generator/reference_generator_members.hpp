// The members of ReferenceGenerator, for the file that instantiates it.
#pragma once

#include "kernel/reference/generator/reference_generator.hpp"

#include <algorithm>
#include <cassert>
#include <new>

namespace tactus {

template <class Space>
Status ReferenceGenerator<Space>::start(ReferenceChannel<Space>& channel, const Params& params,
                                        const Point& measured) {
  if (!measured.finite()) return Status::kStateNotFinite;
  if (channel_ == &channel) {
    end_waiting(Outcome::kAborted);
    end_running(Outcome::kAborted, true);
    motion_.stop();
    release_store();
  }
  // A copy: `measured` may refer to the reference that ends here.
  const Point held = measured;  // NOLINT(performance-unnecessary-copy-initialization)
  FeedbackPublisher<Space> feedback = feedback_;
  feedback.start(params.feedback_divisor, params.measured);
  const OnlyWithStreams<StreamAccount<Space>> stream = stream_;
  new (this) ReferenceGenerator();  // constructed in place: a copy would be large on the stack
  feedback_ = feedback;
  stream_ = stream;
  if constexpr (kStreams) stream_.outputs = {};
  channel_ = &channel;
  params_ = params;
  end_epoch();
  channel.tolerances = &params_.tolerances;
  void_requests_ = channel.requests.size();
  void_controls_ = channel.controls.size();
  motion_.start(held, channel.settings);
  if constexpr (kStreams) motion_.approach_at(params.bounds.approach_speed);
  monitor_.start(held, params.latency_cycles, (params.measured & kVelocityField) != 0);
  monitor_.begin(params.tolerances);
  return Status::kOk;
}

template <class Space>
void ReferenceGenerator<Space>::scale_speed(double scaling) {
  speed_scaling_ = scaling >= 0.0 ? std::min(scaling, 1.0) : 0.0;
  motion_.set_rate(override_ * speed_scaling_);
}

template <class Space>
Status ReferenceGenerator<Space>::step(double dt_s, const Point& measured) {
  if (!motion_.started()) return Status::kNotStarted;
  period_s_ = dt_s;
  measured_ = measured;
  ++cycles_;
  time_s_ = static_cast<double>(cycles_) * period_s_;
  begun_ = false;
  if constexpr (kStreams) stream_.step_s -= dt_s;
  assert(params_.online != OnlineMode::kForward ||
         (phase() != MotionPhase::kLeaving && !motion_.gives_velocity()));
  motion_.move_on(dt_s);
  if constexpr (kStreams) pass_outputs();
  watch_supply();
  watch_goal(dt_s, measured);
  watch_stream(dt_s);
  if constexpr (kStreams) watch_expiry();
  watch_start();
  take_controls();
  take_requests();
  if constexpr (kStreams) stream_.outputs.move_on(time_s());
  release_store();
  monitor_.record(reference());
  if constexpr (kStreams) feedback_.set(running_.any() ? motion_.progress() : PathProgress());
  feedback_.step(cycles_, time_s(), running_.any() ? running_.id : 0, reference(), measured,
                 channel_->feedback);
  if (!reference().finite()) return Status::kReferenceFault;
  return running_.any() ? Status::kOk : monitor_.holds(measured, dt_s).status;
}

/// There is space for the reports of what ends here: see has_room().
template <class Space>
void ReferenceGenerator<Space>::brake(Status why, BrakeWay way) {
  if (channel_ == nullptr) return;
  const bool leave = way == BrakeWay::kAtOnce || !motion_.on_path();
  if (refusing_ == Status::kOk || (way == BrakeWay::kAtOnce && motion_.on_path())) {
    end_waiting(Outcome::kAborted, {why});
    leave ? motion_.stop() : motion_.cancel();
    end_running(Outcome::kAborted, !motion_.on_path(), {why});
    end_epoch();
  }
  refusing_ = why;
  take_controls();
  take_requests();
}

/// Publishes the first waypoint that the motion still needs, and reports once that it has run out
/// of waypoints.
template <class Space>
void ReferenceGenerator<Space>::watch_supply() {
  if (!running_.any() || !motion_.on_path()) return;
  channel_->needed[static_cast<std::size_t>(running_.store)].store(motion_.needed(),
                                                                   std::memory_order_release);
  const bool starving = phase() == MotionPhase::kStarving;
  if (starving && !starving_ && has_room()) report(running_.id, Outcome::kStarved);
  starving_ = starving;
}

/// Ends a goal when the robot has arrived, when it is too late for that, or when it is no longer
/// within the path tolerance. In the last two cases the reference comes to rest.
template <class Space>
void ReferenceGenerator<Space>::watch_goal(double dt_s, const Point& measured) {
  if (!running_.any()) return;
  using Arrival = typename ToleranceMonitor<Space>::Arrival;
  Verdict why = monitor_.follows(measured);
  if (why.ok() && !motion_.at_goal()) return;
  const Arrival arrival = why.ok() ? monitor_.arrived(measured, dt_s, why) : Arrival::kLate;
  if (arrival == Arrival::kWaiting) return;
  arrival == Arrival::kArrived ? motion_.complete() : motion_.stop_inside();
  end_running(arrival == Arrival::kArrived ? Outcome::kSucceeded : Outcome::kAborted,
              !motion_.on_path(), why);
}

/// Ends a stream of points that has gone silent, so that the arm keeps neither velocity nor effort.
/// A stream that gave velocities, or that has a timeout, names no place to go to: it comes to rest
/// the fastest way.
template <class Space>
void ReferenceGenerator<Space>::watch_stream(double dt_s) {
  point_age_s_ += dt_s;
  if (running_.any()) return;
  const bool watched = params_.timeout_s > 0.0;
  if (motion_.silent() && (watched || motion_.gives_velocity())) return motion_.stop();
  if (!watched || point_age_s_ < params_.timeout_s) return;
  if (params_.online != OnlineMode::kForward && phase() != MotionPhase::kHolding) return;
  point_age_s_ = -kInfinity;
  if (!reference().idle()) motion_.stop();
}

/// Begins a waiting trajectory in the cycle nearest to its start time.
template <class Space>
void ReferenceGenerator<Space>::watch_start() {
  if (!waiting_.any() || trajectory(waiting_).start_s - time_s() > 0.5 * period_s_) return;
  const Goal due = waiting_;
  waiting_ = {};
  static_cast<void>(begin(due, 0.0));
}

/// Leaves the running trajectory for that of `goal`, which began `elapsed_s` ago. Returns false if
/// it is refused; the running one then continues. Called at most once in a cycle,
/// and not while the executive brakes.
template <class Space>
bool ReferenceGenerator<Space>::begin(const Goal& goal, double elapsed_s) {
  assert(!begun_ && refusing_ == Status::kOk);
  begun_ = true;
  const Verdict verdict =
      motion_.follow(trajectory(goal), params_.start_tolerance, measured_, elapsed_s);
  if (!verdict.ok()) {
    report(goal.id, Outcome::kRefused, goal.store, verdict);
    return false;
  }
  end_running(Outcome::kPreempted, true);
  running_ = goal;
  starving_ = false;
  monitor_.begin(Tolerances<Space>::merged(trajectory(goal).tolerances, params_.tolerances));
  const bool pauses = kStreams && phase() == MotionPhase::kPaused;
  report(goal.id, Outcome::kStarted, -1, {pauses ? Status::kPaused : Status::kOk});
  return true;
}

template <class Space>
void ReferenceGenerator<Space>::end_waiting(Outcome outcome, const Verdict& verdict) {
  if (waiting_.any()) report(waiting_.id, outcome, waiting_.store, verdict);
  waiting_ = {};
}

/// Reports the end of the trajectory being executed, if there is one. Returns its store, and that
/// of a trajectory given up before, if the motion has left the path.
template <class Space>
void ReferenceGenerator<Space>::end_running(Outcome outcome, bool path_left,
                                            const Verdict& verdict) {
  if (path_left && braked_on_ >= 0) {
    report(0, Outcome::kReleased, braked_on_);
    braked_on_ = -1;
  }
  if (!running_.any()) return;
  report(running_.id, outcome, path_left ? running_.store : -1, verdict);
  if (!path_left) braked_on_ = running_.store;
  running_ = {};
  monitor_.begin(params_.tolerances);
}

/// Returns the store of a trajectory that was given up, once the motion has left its path.
template <class Space>
void ReferenceGenerator<Space>::release_store() {
  if (braked_on_ < 0 || motion_.on_path()) return;
  const Verdict verdict = {motion_.lost_path() ? Status::kLeftPath : Status::kOk};
  report(0, Outcome::kReleased, braked_on_, verdict);
  braked_on_ = -1;
}

template <class Space>
void ReferenceGenerator<Space>::report(std::uint32_t id, Outcome outcome, int store,
                                       const Verdict& verdict) {
  // Never full: see has_room().
  static_cast<void>(channel_->reports.post({id, outcome, store, verdict, time_s()}));
}

}  // namespace tactus
