// What a reference generator does with each kind of control and request.
#include <cmath>

#include "kernel/loop_bound.hpp"
#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/reference_generator.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

// One request causes at most four reports in its cycle (what it supersedes, a trajectory that ends,
// a store released, its own), and what runs and waits after it six more later: a point, a
// trajectory that ends and its store, one that starts, ends, and its store. A request waits in its
// mailbox until there is room for all of them, and for one report of every control that can be
// unanswered, so no report is ever lost.
constexpr std::size_t kReportsPerRequest = 10;

}  // namespace

template <class Space>
bool ReferenceGenerator<Space>::has_room() const {
  return channel_->reports.space() >= kReportsPerRequest + kControls;
}

/// All of them, in every cycle, before any request: nothing holds them up.
template <class Space>
void ReferenceGenerator<Space>::take_controls() {
  Control control;
  LoopBound<kControls> controls;
  for (std::size_t i = 0; i < kControls; ++i) {
    controls.tick();
    if (!channel_->controls.take(control)) break;
    const Verdict verdict = answer(control);
    report(control.id, verdict.ok() ? Outcome::kExecuted : Outcome::kRefused, -1, verdict);
  }
}

template <class Space>
Verdict ReferenceGenerator<Space>::answer(const Control& control) {
  if (void_controls_ > 0) return --void_controls_, Verdict{Status::kNotStarted};
  if (refusing_ != Status::kOk) return {refusing_};
  switch (control.kind) {
    case ControlKind::kCancel:
      return cancel(control.id);
    case ControlKind::kOverride:
      return set_override(control.rate);
    case ControlKind::kPause:
    case ControlKind::kResume:
      break;
  }
  motion_.pause(control.kind == ControlKind::kPause);
  return {};
}

/// Cancels what runs, what waits and what was sent before and is not yet taken.
template <class Space>
Verdict ReferenceGenerator<Space>::cancel(std::uint32_t id) {
  const bool goes = running_.any() || waiting_.any() || phase() == Phase::kReaching;
  if (!goes && channel_->requests.size() == 0) return {Status::kNothingToCancel};
  canceled_before_ = id;
  end_waiting(Outcome::kCanceled);
  if (!goes) return {};
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

template <class Space>
void ReferenceGenerator<Space>::take_requests() {
  Request<Space> request;
  LoopBound<16> requests;  // what a mailbox holds
  for (std::size_t i = 0; i < channel_->requests.capacity(); ++i) {
    if (begun_ && refusing_ == Status::kOk) break;
    requests.tick();
    if (!has_room() || !channel_->requests.take(request)) break;
    answer(request);
  }
}

template <class Space>
void ReferenceGenerator<Space>::answer(const Request<Space>& request) {
  if (void_requests_ > 0) return --void_requests_, refuse(request, Status::kNotStarted);
  if (refusing_ != Status::kOk) return refuse(request, refusing_);
  if (canceled(request)) return;
  switch (request.kind) {
    case RequestKind::kPoint:
      return take_point(request);
    case RequestKind::kTrajectory:
      return take_trajectory(request);
    case RequestKind::kAppend:
      return take_append(request);
  }
}

/// A point or a trajectory that was sent before the last cancel is given up as that says. Numbers
/// run in a circle.
template <class Space>
bool ReferenceGenerator<Space>::canceled(const Request<Space>& request) {
  const bool older = static_cast<std::int32_t>(canceled_before_ - request.id) > 0;
  if (!older || request.kind == RequestKind::kAppend) return false;
  const bool point = request.kind == RequestKind::kPoint;
  report(request.id, point ? Outcome::kSuperseded : Outcome::kCanceled, point ? -1 : request.store);
  return true;
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

/// A point ends what ran before it, whatever it was: the paper's rule. Of several in a cycle the
/// newest wins.
template <class Space>
void ReferenceGenerator<Space>::take_point(const Request<Space>& request) {
  const typename Space::Limits& limits = channel_->settings.limits;
  const Point point =
      Space::placed(request.point, Space::latch(request.terms, reference(), limits));
  const Verdict verdict = judge_point(point);
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  settle_point(Outcome::kSuperseded);
  params_.online == OnlineMode::kLimit ? motion_.reach(point) : motion_.forward(point);
  end_running(Outcome::kAborted, true);
  point_age_s_ = 0.0;
  point_pending_ = true;
  point_id_ = request.id;
}

/// A trajectory begins at once, waits for its start time, or is joined late. A newer one takes the
/// place of one that waits.
template <class Space>
void ReferenceGenerator<Space>::take_trajectory(const Request<Space>& request) {
  const Goal goal = {request.id, request.store};
  const bool known = request.store >= 0 && request.store < kStores &&
                     request.store != running_.store && request.store != waiting_.store &&
                     request.store != braked_on_;
  if (!known || trajectory(goal).count < 1)
    return report(request.id, Outcome::kRefused, -1, {Status::kReferenceSize});
  const double start_s = trajectory(goal).start_s, elapsed_s = time_s() - start_s;
  const bool now = start_s == kStartAtOnce || std::abs(elapsed_s) <= 0.5 * period_s_;
  if (!now && !(std::isfinite(elapsed_s) && elapsed_s < trajectory(goal).end_s()))
    return report(request.id, Outcome::kRefused, request.store,
                  {Status::kReferenceTime, -1, -1, start_s, time_s()});
  const bool later = !now && elapsed_s < 0.0;
  if (!later && !begin(goal, now ? 0.0 : elapsed_s)) return;
  end_waiting(Outcome::kSuperseded);
  if (!later) return;
  waiting_ = goal;
  report(request.id, Outcome::kScheduled);
}

/// Waypoints that the client has put behind those of a trajectory that runs or waits.
template <class Space>
void ReferenceGenerator<Space>::take_append(const Request<Space>& request) {
  const bool runs = running_.any() && request.store == running_.store && motion_.on_path();
  const bool waits = waiting_.any() && request.store == waiting_.store;
  const Goal goal = {request.id, request.store};
  if (!(runs || waits) || !trajectory(goal).open || request.count < trajectory(goal).count)
    return report(request.id, Outcome::kRefused, -1, {Status::kNothingToExtend});
  const Verdict verdict = runs ? motion_.extend(request.use) : Verdict();
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  trajectory(goal).count = request.count;
  channel_->known[static_cast<std::size_t>(request.store)].store(
      request.last ? -request.count : request.count, std::memory_order_release);
  trajectory(goal).open = !request.last;
  trajectory(goal).use = Space::Use::largest(trajectory(goal).use, request.use);
  report(request.id, Outcome::kExecuted);
}

template bool ReferenceGenerator<JointSpace>::has_room() const;
template bool ReferenceGenerator<TaskSpace>::has_room() const;
template void ReferenceGenerator<JointSpace>::take_controls();
template void ReferenceGenerator<TaskSpace>::take_controls();
template void ReferenceGenerator<JointSpace>::take_requests();
template void ReferenceGenerator<TaskSpace>::take_requests();

}  // namespace tactus
