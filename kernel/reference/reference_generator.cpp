#include "kernel/reference/reference_generator.hpp"

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

// One request causes at most four reports in its cycle (a superseded point, a trajectory that ends,
// a store released, its own), and what it leaves running three more later. A request waits in its
// mailbox until there is room for all of them, so no report is ever lost.
constexpr std::size_t kReportsPerRequest = 8;

}  // namespace

template <class Space>
Status ReferenceGenerator<Space>::start(ReferenceChannel<Space>& channel, const Params& params,
                                        const Point& measured) {
  if (!measured.finite()) return Status::kStateNotFinite;
  if (channel_ == &channel) {
    end_execution(ReferenceEvent::kNewReference, Outcome::kAborted, true);
  }
  FeedbackPublisher<Space> feedback = feedback_;
  feedback.start(params.feedback_divisor, params.measured);
  *this = ReferenceGenerator();
  feedback_ = feedback;
  channel_ = &channel;
  params_ = params;
  void_requests_ = channel.requests.size();
  motion_.start(measured, channel.settings);
  monitor_.start(measured, params.latency_cycles);
  return Status::kOk;
}

template <class Space>
Status ReferenceGenerator<Space>::step(double dt_s, const Point& measured) {
  if (channel_ == nullptr) return Status::kNotStarted;
  period_s_ = dt_s;
  motion_.move_on(dt_s);
  watch_supply();
  watch_goal(dt_s, measured);
  watch_stream(dt_s);
  Request<Space> request;
  for (std::size_t i = 0; i < channel_->requests.capacity(); ++i) {
    if (channel_->reports.space() < kReportsPerRequest || !channel_->requests.take(request)) break;
    answer(request);
  }
  settle_point(Outcome::kExecuted);
  release_store();
  monitor_.put_out(reference());
  feedback_.step(dt_s, executing() ? trajectory_id_ : 0, reference(), measured, channel_->feedback);
  return reference().finite() ? Status::kOk : Status::kReferenceFault;
}

template <class Space>
void ReferenceGenerator<Space>::answer(const Request<Space>& request) {
  if (void_requests_ > 0) {
    --void_requests_;
    const bool carries_store = request.kind == RequestKind::kTrajectory;
    return report(request.id, Outcome::kRefused, carries_store ? request.store : -1,
                  {Status::kNotStarted});
  }
  switch (request.kind) {
    case RequestKind::kPoint:
      return take_point(request);
    case RequestKind::kTrajectory:
      return take_trajectory(request);
    case RequestKind::kCancel:
      return take_cancel(request);
    case RequestKind::kOverride:
      return take_override(request);
    case RequestKind::kPause:
    case RequestKind::kResume:
      return take_pause(request);
    case RequestKind::kAppend:
      return take_append(request);
  }
}

template <class Space>
Verdict ReferenceGenerator<Space>::judge_point(const Point& point) const {
  const typename Space::Limits& limits = channel_->settings.limits;
  const Verdict verdict = Space::judge(point, limits);
  if (!verdict.ok() || params_.online != OnlineMode::kRefuse) return verdict;
  return Space::judge_reach(reference(), point, limits, period_s_);
}

/// A point ends what ran before it, whatever it was: the paper's rule.
template <class Space>
void ReferenceGenerator<Space>::take_point(const Request<Space>& request) {
  const Verdict verdict = judge_point(request.point);
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  settle_point(Outcome::kSuperseded);
  if (params_.online == OnlineMode::kLimit)
    motion_.shape(request.point);
  else
    motion_.forward(request.point);
  end_execution(ReferenceEvent::kNewReference, Outcome::kAborted, true);
  point_age_s_ = 0.0;
  point_pending_ = true;
  point_id_ = request.id;
}

template <class Space>
void ReferenceGenerator<Space>::take_trajectory(const Request<Space>& request) {
  const bool known = request.store >= 0 && request.store < kStores && request.store != store_;
  const Trajectory<Space>* trajectory =
      known ? &channel_->stores[static_cast<std::size_t>(request.store)] : nullptr;
  if (trajectory == nullptr || trajectory->count < 1)
    return report(request.id, Outcome::kRefused, -1, {Status::kReferenceSize});
  const Verdict verdict = motion_.follow(*trajectory, params_.start_tolerance);
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, request.store, verdict);
  end_execution(ReferenceEvent::kTrajectoryAccepted, Outcome::kPreempted, true);
  trajectory_id_ = request.id;
  store_ = request.store;
  monitor_.begin(Tolerances<Space>::merged(trajectory->tolerances, params_.tolerances));
  motion_.set_rate(paused_ ? 0.0 : override_);
  report(request.id, Outcome::kStarted);
}

template <class Space>
void ReferenceGenerator<Space>::take_cancel(const Request<Space>& request) {
  if (!executing()) return report(request.id, Outcome::kRefused, -1, {Status::kNothingToCancel});
  motion_.brake();
  end_execution(ReferenceEvent::kTrajectoryCanceled, Outcome::kCanceled, !motion_.on_path());
  report(request.id, Outcome::kExecuted);
}

template <class Space>
void ReferenceGenerator<Space>::take_override(const Request<Space>& request) {
  if (!(request.rate >= 0.0 && request.rate <= 1.0))
    return report(request.id, Outcome::kRefused, -1,
                  {Status::kBadOverride, -1, -1, request.rate, 1.0});
  override_ = request.rate;
  if (!paused_) motion_.set_rate(override_);
  report(request.id, Outcome::kExecuted);
}

template <class Space>
void ReferenceGenerator<Space>::take_pause(const Request<Space>& request) {
  paused_ = request.kind == RequestKind::kPause;
  motion_.set_rate(paused_ ? 0.0 : override_);
  report(request.id, Outcome::kExecuted);
}

/// Waypoints that the client has put behind those of the trajectory being executed.
template <class Space>
void ReferenceGenerator<Space>::take_append(const Request<Space>& request) {
  const bool known = executing() && request.store == store_ && motion_.on_path();
  Trajectory<Space>* trajectory =
      known ? &channel_->stores[static_cast<std::size_t>(store_)] : nullptr;
  if (trajectory == nullptr || !trajectory->open || request.count < trajectory->count)
    return report(request.id, Outcome::kRefused, -1, {Status::kNothingToExtend});
  trajectory->count = request.count;
  trajectory->open = !request.last;
  trajectory->use = PathUse::largest(trajectory->use, request.use);
  motion_.extend();
  report(request.id, Outcome::kExecuted);
}

/// Tells the client how far the motion is, and once that it has run out of waypoints.
template <class Space>
void ReferenceGenerator<Space>::watch_supply() {
  if (!executing() || !motion_.on_path()) return;
  channel_->needed[static_cast<std::size_t>(store_)].store(motion_.needed(),
                                                           std::memory_order_release);
  const bool told = starving_ || channel_->reports.space() <= kReportsPerRequest;
  if (motion_.starving() && !told) report(trajectory_id_, Outcome::kStarved);
  starving_ = motion_.starving();
}

/// A goal ends when the robot is where it should be, or when it cannot be said to follow any more:
/// then the arm is brought to rest where it is measured to be, because holding the reference would
/// keep pushing towards it.
template <class Space>
void ReferenceGenerator<Space>::watch_goal(double dt_s, const Point& measured) {
  if (!executing()) return;
  using Arrival = typename ToleranceMonitor<Space>::Arrival;
  Verdict why = monitor_.follows(measured);
  if (why.ok() && motion_.on_path()) return;
  const Arrival arrival = why.ok() ? monitor_.arrived(measured, dt_s, why) : Arrival::kLate;
  if (arrival == Arrival::kWaiting) return;
  if (arrival == Arrival::kArrived)
    return end_execution(ReferenceEvent::kTrajectoryCompleted, Outcome::kSucceeded, true);
  if (measured.at_rest().finite()) motion_.shape(measured);
  end_execution(ReferenceEvent::kTrajectoryCompleted, Outcome::kAborted, !motion_.on_path(), why);
}

/// A stream of points that dries up must not leave the arm with a velocity or an effort.
template <class Space>
void ReferenceGenerator<Space>::watch_stream(double dt_s) {
  point_age_s_ += dt_s;
  if (executing() || params_.timeout_s <= 0.0 || point_age_s_ < params_.timeout_s) return;
  if (!motion_.standing() || reference().idle()) return;
  motion_.shape(reference());
}

/// The trajectory being executed, if there is one, is reported as ended. Its store goes back as
/// soon as the motion has left its path.
template <class Space>
void ReferenceGenerator<Space>::end_execution(ReferenceEvent event, Outcome outcome, bool path_left,
                                              const Verdict& verdict) {
  if (executing())
    report(trajectory_id_, outcome, path_left ? store_ : -1, verdict);
  else if (path_left && store_ >= 0)
    report(0, Outcome::kReleased, store_);
  if (path_left) store_ = -1;
  state_ = next(state_, event);
}

/// Gives back the store of a path that came to rest after its final report.
template <class Space>
void ReferenceGenerator<Space>::release_store() {
  if (store_ < 0 || executing() || motion_.on_path()) return;
  report(0, Outcome::kReleased, store_);
  store_ = -1;
}

template <class Space>
void ReferenceGenerator<Space>::settle_point(Outcome outcome) {
  if (point_pending_) report(point_id_, outcome);
  point_pending_ = false;
}

template <class Space>
void ReferenceGenerator<Space>::report(std::uint32_t id, Outcome outcome, int store,
                                       const Verdict& verdict) {
  // Never full: see kReportsPerRequest.
  static_cast<void>(channel_->reports.post({id, outcome, store, verdict}));
}

template class ReferenceGenerator<JointSpace>;
template class ReferenceGenerator<TaskSpace>;

}  // namespace tactus
