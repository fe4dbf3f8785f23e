// What a reference generator does with each kind of request.
#include <cmath>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/reference_generator.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {

template <class Space>
void ReferenceGenerator<Space>::answer(const Request<Space>& request) {
  if (void_requests_ > 0) return --void_requests_, refuse(request, Status::kNotStarted);
  if (refusing_ != Status::kOk) return refuse(request, refusing_);
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

/// Refused whatever it asks for; the store it came with goes back.
template <class Space>
void ReferenceGenerator<Space>::refuse(const Request<Space>& request, Status why) {
  const bool carries_store = request.kind == RequestKind::kTrajectory;
  report(request.id, Outcome::kRefused, carries_store ? request.store : -1, {why});
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
  const Point point = Space::placed(request.point, Space::latch(request.terms, reference()));
  Verdict verdict = judge_point(point);
  if (verdict.ok() && params_.online == OnlineMode::kLimit) verdict = shape(point);
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  settle_point(Outcome::kSuperseded);
  if (params_.online != OnlineMode::kLimit) motion_.forward(point);
  end_execution(ReferenceEvent::kNewReference, Outcome::kAborted, true);
  point_age_s_ = 0.0;
  point_pending_ = true;
  point_id_ = request.id;
}

/// A trajectory begins at once, waits for its start time, or is joined late. A newer one takes the
/// place of one that waits.
template <class Space>
void ReferenceGenerator<Space>::take_trajectory(const Request<Space>& request) {
  const bool known = request.store >= 0 && request.store < kStores &&
                     request.store != running_.store && request.store != waiting_.store;
  const Trajectory<Space>* trajectory =
      known ? &channel_->stores[static_cast<std::size_t>(request.store)] : nullptr;
  if (trajectory == nullptr || trajectory->count < 1)
    return report(request.id, Outcome::kRefused, -1, {Status::kReferenceSize});
  const double start_s = trajectory->start_s, elapsed_s = time_s() - start_s;
  const bool now = start_s == kStartAtOnce || std::abs(elapsed_s) <= 0.5 * period_s_;
  if (!now && !(std::isfinite(elapsed_s) && elapsed_s < trajectory->end_s()))
    return report(request.id, Outcome::kRefused, request.store,
                  {Status::kReferenceTime, -1, -1, start_s, time_s()});
  const Goal goal = {request.id, request.store};
  const bool later = !now && elapsed_s < 0.0;
  if (!later && !begin(goal, now ? 0.0 : elapsed_s)) return;
  end_waiting(Outcome::kSuperseded);
  if (!later) return;
  waiting_ = goal;
  report(request.id, Outcome::kScheduled);
}

/// Cancels what runs and what waits.
template <class Space>
void ReferenceGenerator<Space>::take_cancel(const Request<Space>& request) {
  if (!executing() && waiting_.store < 0)
    return report(request.id, Outcome::kRefused, -1, {Status::kNothingToCancel});
  end_waiting(Outcome::kCanceled);
  if (executing()) {
    motion_.brake();
    end_execution(ReferenceEvent::kTrajectoryCanceled, Outcome::kCanceled, !motion_.on_path());
  }
  report(request.id, Outcome::kExecuted);
}

template <class Space>
void ReferenceGenerator<Space>::take_override(const Request<Space>& request) {
  if (!(request.rate >= 0.0 && request.rate <= 1.0))
    return report(request.id, Outcome::kRefused, -1,
                  {Status::kBadOverride, -1, -1, request.rate, 1.0});
  override_ = request.rate;
  motion_.set_rate(rate());
  report(request.id, Outcome::kExecuted);
}

template <class Space>
void ReferenceGenerator<Space>::take_pause(const Request<Space>& request) {
  paused_ = request.kind == RequestKind::kPause;
  motion_.set_rate(rate());
  report(request.id, Outcome::kExecuted);
}

/// Waypoints that the client has put behind those of a trajectory that runs or waits.
template <class Space>
void ReferenceGenerator<Space>::take_append(const Request<Space>& request) {
  const bool runs = executing() && request.store == running_.store && motion_.on_path();
  const bool waits = request.store >= 0 && request.store == waiting_.store;
  Trajectory<Space>* trajectory =
      runs || waits ? &channel_->stores[static_cast<std::size_t>(request.store)] : nullptr;
  if (trajectory == nullptr || !trajectory->open || request.count < trajectory->count)
    return report(request.id, Outcome::kRefused, -1, {Status::kNothingToExtend});
  const Verdict verdict = runs ? motion_.extend(request.use) : Verdict();
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  trajectory->count = request.count;
  trajectory->open = !request.last;
  trajectory->use = Space::Use::largest(trajectory->use, request.use);
  report(request.id, Outcome::kExecuted);
}

template void ReferenceGenerator<JointSpace>::answer(const Request<JointSpace>&);
template void ReferenceGenerator<TaskSpace>::answer(const Request<TaskSpace>&);

}  // namespace tactus
