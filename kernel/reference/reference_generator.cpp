#include "kernel/reference/reference_generator.hpp"

#include <algorithm>

#include "kernel/loop_bound.hpp"
#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

// One request causes at most four reports in its cycle (what it supersedes, a trajectory that ends,
// a store released, its own), and what runs and waits after it six more later: a point, a
// trajectory that ends and its store, one that starts, ends, and its store. A request waits in its
// mailbox until there is room for all of them, so no report is ever lost.
constexpr std::size_t kReportsPerRequest = 10;

}  // namespace

template <class Space>
Status ReferenceGenerator<Space>::start(ReferenceChannel<Space>& channel, const Params& params,
                                        const Point& measured) {
  if (!measured.finite()) return Status::kStateNotFinite;
  if (channel_ == &channel) {
    end_execution(ReferenceEvent::kNewReference, Outcome::kAborted, true);
    end_waiting(Outcome::kAborted);
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
void ReferenceGenerator<Space>::scale_speed(double scaling) {
  const double bounded = scaling >= 0.0 ? std::min(scaling, 1.0) : 0.0;
  if (bounded == speed_scaling_) return;
  speed_scaling_ = bounded;
  motion_.set_rate(rate());
}

template <class Space>
Status ReferenceGenerator<Space>::step(double dt_s, const Point& measured) {
  if (channel_ == nullptr) return Status::kNotStarted;
  period_s_ = dt_s;
  ++cycles_;
  motion_.move_on(dt_s);
  watch_supply();
  watch_goal(dt_s, measured);
  watch_stream(dt_s);
  watch_start();
  take_requests();
  settle_point(Outcome::kExecuted);
  release_store();
  monitor_.put_out(reference());
  feedback_.step(cycles_, time_s(), executing() ? running_.id : 0, reference(), measured,
                 channel_->feedback);
  planned_ = false;
  return reference().finite() ? Status::kOk : Status::kReferenceFault;
}

template <class Space>
void ReferenceGenerator<Space>::take_requests() {
  Request<Space> request;
  LoopBound<16> requests;  // what a mailbox holds
  for (std::size_t i = 0; i < channel_->requests.capacity(); ++i) {
    if (planned_ && refusing_ == Status::kOk) break;
    requests.tick();
    if (channel_->reports.space() < kReportsPerRequest || !channel_->requests.take(request)) break;
    answer(request);
  }
}

/// The reports of what ends here have their room: see kReportsPerRequest.
template <class Space>
void ReferenceGenerator<Space>::brake(Status why, BrakeWay /*way*/) {
  if (channel_ == nullptr) return;
  if (refusing_ == Status::kOk) {
    end_waiting(Outcome::kAborted, {why});
    if (!executing()) stand();
    motion_.brake();
    end_execution(ReferenceEvent::kTrajectoryCanceled, Outcome::kAborted, !motion_.on_path(),
                  {why});
  }
  refusing_ = why;
  take_requests();
}

/// Tells the client how far the motion is, and once that it has run out of waypoints.
template <class Space>
void ReferenceGenerator<Space>::watch_supply() {
  if (!executing() || !motion_.on_path()) return;
  channel_->needed[static_cast<std::size_t>(running_.store)].store(motion_.needed(),
                                                                   std::memory_order_release);
  const bool told = starving_ || channel_->reports.space() <= kReportsPerRequest;
  if (motion_.starving() && !told) report(running_.id, Outcome::kStarved);
  starving_ = motion_.starving();
}

/// A goal ends when the robot is where it should be, or when it cannot be said to follow any more:
/// then the arm is brought to rest where it is measured to be, because holding the reference would
/// keep pushing towards it; on its path, if there is no room for that.
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
  if (!measured.at_rest().finite() || !shape(measured).ok()) motion_.brake();
  end_execution(ReferenceEvent::kTrajectoryCompleted, Outcome::kAborted, !motion_.on_path(), why);
}

/// A stream of points that dries up must not leave the arm with a velocity or an effort.
template <class Space>
void ReferenceGenerator<Space>::watch_stream(double dt_s) {
  point_age_s_ += dt_s;
  if (executing() || params_.timeout_s <= 0.0 || point_age_s_ < params_.timeout_s) return;
  if (motion_.standing()) stand();
}

/// Off a path: comes to rest beside the point that is put out. Where there is no room to brake it
/// stands at once: points that are forwarded may step.
template <class Space>
void ReferenceGenerator<Space>::stand() {
  if (planned_ || motion_.on_path() || reference().idle()) return;
  if (!shape(reference()).ok()) motion_.forward(reference().at_rest());
}

/// A trajectory that waits begins in the cycle nearest to its start time, or in the next if that
/// has made its plan.
template <class Space>
void ReferenceGenerator<Space>::watch_start() {
  if (waiting_.store < 0 || planned_) return;
  const Trajectory<Space>& trajectory = channel_->stores[static_cast<std::size_t>(waiting_.store)];
  if (trajectory.start_s - time_s() > 0.5 * period_s_) return;
  const Goal due = waiting_;
  waiting_ = {};
  static_cast<void>(begin(due, 0.0));
}

template <class Space>
Verdict ReferenceGenerator<Space>::shape(const Point& point) {
  planned_ = true;
  return motion_.shape(point);
}

/// Leaves what runs for the trajectory of `goal`, which began `elapsed_s` ago. False: it is
/// refused, and what runs goes on.
template <class Space>
bool ReferenceGenerator<Space>::begin(const Goal& goal, double elapsed_s) {
  const Trajectory<Space>& trajectory = channel_->stores[static_cast<std::size_t>(goal.store)];
  planned_ = true;
  const Verdict verdict = motion_.follow(trajectory, params_.start_tolerance, elapsed_s);
  if (!verdict.ok()) return report(goal.id, Outcome::kRefused, goal.store, verdict), false;
  end_execution(ReferenceEvent::kTrajectoryAccepted, Outcome::kPreempted, true);
  running_ = goal;
  monitor_.begin(Tolerances<Space>::merged(trajectory.tolerances, params_.tolerances));
  motion_.set_rate(rate());
  report(goal.id, Outcome::kStarted);
  return true;
}

template <class Space>
void ReferenceGenerator<Space>::end_waiting(Outcome outcome, const Verdict& verdict) {
  if (waiting_.store >= 0) report(waiting_.id, outcome, waiting_.store, verdict);
  waiting_ = {};
}

/// The trajectory being executed, if there is one, is reported as ended. Its store goes back as
/// soon as the motion has left its path.
template <class Space>
void ReferenceGenerator<Space>::end_execution(ReferenceEvent event, Outcome outcome, bool path_left,
                                              const Verdict& verdict) {
  if (executing())
    report(running_.id, outcome, path_left ? running_.store : -1, verdict);
  else if (path_left && running_.store >= 0)
    report(0, Outcome::kReleased, running_.store);
  if (path_left) running_.store = -1;
  state_ = next(state_, event);
}

/// Gives back the store of a path that came to rest after its final report.
template <class Space>
void ReferenceGenerator<Space>::release_store() {
  if (running_.store < 0 || executing() || motion_.on_path()) return;
  report(0, Outcome::kReleased, running_.store);
  running_.store = -1;
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
  static_cast<void>(channel_->reports.post({id, outcome, store, verdict, time_s()}));
}

template class ReferenceGenerator<JointSpace>;
template class ReferenceGenerator<TaskSpace>;

}  // namespace tactus
