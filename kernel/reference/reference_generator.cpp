#include "kernel/reference/reference_generator.hpp"

namespace tactus {
namespace {

// One request causes at most three reports in its cycle, and what it leaves running two more later.
// A request waits in its mailbox until there is room for all of them, so no report is ever lost.
constexpr std::size_t kReportsPerRequest = 6;
// Times are sums of periods; a billionth of a second is far below any period and far above their
// rounding.
constexpr double kTimeRounding_s = 1e-9;

}  // namespace

template <class Space>
Status ReferenceGenerator<Space>::start(ReferenceChannel<Space>& channel,
                                        const JointVector& start_tolerance, const Point& measured) {
  if (!measured.finite()) return Status::kStateNotFinite;
  if (channel_ == &channel && executing())
    report(execution_.id, Outcome::kAborted, execution_.store);
  *this = ReferenceGenerator();
  channel_ = &channel;
  void_requests_ = channel.requests.size();
  start_tolerance_ = start_tolerance;
  reference_ = held_ = measured.at_rest();
  return Status::kOk;
}

template <class Space>
Status ReferenceGenerator<Space>::step(double dt_s) {
  if (channel_ == nullptr) return Status::kNotStarted;
  move_on(dt_s);
  Request<Space> request;
  for (std::size_t i = 0; i < channel_->requests.capacity(); ++i) {
    if (channel_->reports.space() < kReportsPerRequest || !channel_->requests.take(request)) break;
    answer(request);
  }
  settle_point(Outcome::kExecuted);
  return reference_.finite() ? Status::kOk : Status::kReferenceFault;
}

template <class Space>
void ReferenceGenerator<Space>::move_on(double dt_s) {
  execution_.time_s += dt_s;
  bridge_time_s_ += dt_s;
  reference_ = base();
  bridging_ = bridging_ && bridge_time_s_ < bridge_.duration();
  if (bridging_) reference_ = Space::sum(reference_, bridge_.at(bridge_time_s_));
}

/// The running trajectory at its present time, or the point that is held. Ends a trajectory whose
/// time is up.
template <class Space>
typename Space::Point ReferenceGenerator<Space>::base() {
  if (!executing()) return held_;
  Execution& now = execution_;
  const Trajectory<Space>& trajectory = *now.trajectory;
  const double due_s = now.time_s + kTimeRounding_s;
  if (due_s >= trajectory.end_s()) {
    held_ = trajectory.waypoints[trajectory.count - 1].point.at_rest();
    end_execution(ReferenceEvent::kTrajectoryCompleted, Outcome::kSucceeded);
    return held_;
  }
  int target = now.target;
  for (int i = 0; i < kMaxSegmentsPerCycle && due_s >= trajectory.waypoints[target].time_s; ++i) {
    ++target;
  }
  if (target != now.target) {
    now.target = target;
    now.segment = trajectory.segment(target);
    now.segment_start_s = trajectory.waypoints[target - 1].time_s;
  }
  return now.segment.at(now.time_s - now.segment_start_s);
}

template <class Space>
void ReferenceGenerator<Space>::answer(const Request<Space>& request) {
  if (void_requests_ > 0) {
    --void_requests_;
    return report(request.id, Outcome::kRefused, request.store, {Status::kNotStarted});
  }
  switch (request.kind) {
    case RequestKind::kPoint:
      return take_point(request);
    case RequestKind::kTrajectory:
      return take_trajectory(request);
    case RequestKind::kCancel:
      return take_cancel(request);
  }
}

/// An online point is forwarded as it came; what ran before ends.
template <class Space>
void ReferenceGenerator<Space>::take_point(const Request<Space>& request) {
  const Verdict verdict = admit(request.point, channel_->settings.limits);
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  settle_point(Outcome::kSuperseded);
  end_execution(ReferenceEvent::kNewReference, Outcome::kAborted);
  reference_ = held_ = request.point;
  bridging_ = false;
  point_pending_ = true;
  point_id_ = request.id;
}

template <class Space>
void ReferenceGenerator<Space>::take_trajectory(const Request<Space>& request) {
  Execution execution;
  const Verdict verdict = prepare(request, execution);
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, request.store, verdict);
  end_execution(ReferenceEvent::kTrajectoryAccepted, Outcome::kPreempted);
  execution_ = execution;
  Point begin = execution.segment.at(0.0);
  // Where a straight line begins its velocity steps by nature; the bridge ends the old motion only.
  if (execution.segment.linear()) begin = begin.at_rest();
  bridge_to(begin,
            Space::bridge_time_s(Space::difference(reference_, begin), channel_->settings.limits));
  report(request.id, Outcome::kStarted, request.store);
}

template <class Space>
void ReferenceGenerator<Space>::take_cancel(const Request<Space>& request) {
  if (!executing()) return report(request.id, Outcome::kRefused, -1, {Status::kNothingToCancel});
  end_execution(ReferenceEvent::kTrajectoryCanceled, Outcome::kCanceled);
  const JointLimits& limits = channel_->settings.limits;
  const double brake_s = Space::brake_time_s(reference_, limits);
  held_ = Space::stop(reference_, brake_s, limits);
  bridge_to(held_, brake_s);
  report(request.id, Outcome::kExecuted);
}

/// The first segment of a trajectory: from the present reference if the first waypoint lies in the
/// future, else from that waypoint, which must then be near.
template <class Space>
Verdict ReferenceGenerator<Space>::prepare(const Request<Space>& request,
                                           Execution& execution) const {
  if (request.store < 0 || request.store >= kStores) return {Status::kReferenceSize};
  const Trajectory<Space>& trajectory = channel_->stores[static_cast<std::size_t>(request.store)];
  if (trajectory.count < 1) return {Status::kReferenceSize};
  execution.trajectory = &trajectory;
  execution.id = request.id;
  execution.store = request.store;
  const Waypoint<Space>& first = trajectory.waypoints[0];
  if (first.time_s > 0.0) {
    execution.segment =
        Segment(reference_, first.point, first.time_s, trajectory.interpolation, trajectory.fields);
    return admit(execution.segment, 0, channel_->settings.limits);
  }
  execution.target = trajectory.count > 1 ? 1 : 0;
  execution.segment = trajectory.count > 1
                          ? trajectory.segment(1)
                          : Segment(first.point, first.point, 1.0, Interpolation::kLinear, 0);
  return within(first.point, reference_, start_tolerance_);
}

template <class Space>
void ReferenceGenerator<Space>::end_execution(ReferenceEvent event, Outcome outcome) {
  if (executing()) report(execution_.id, outcome, execution_.store);
  state_ = next(state_, event);
}

/// Joins the present reference to a base that begins at `base`.
template <class Space>
void ReferenceGenerator<Space>::bridge_to(const Point& base, double duration_s) {
  const Point difference = Space::difference(reference_, base);
  bridge_ = Segment(difference, Point(), duration_s, Interpolation::kQuintic, 0);
  bridge_time_s_ = 0.0;
  bridging_ = true;
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

}  // namespace tactus
