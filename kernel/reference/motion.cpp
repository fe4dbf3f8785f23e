#include "kernel/reference/motion.hpp"

#include <algorithm>

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {
namespace {

// A bridge always gets at least this share of the limits, even beside a path that leaves nothing.
constexpr double kLeastShare = 0.02;

}  // namespace

template <class Space>
void Motion<Space>::start(const Point& point, const Settings& settings) {
  *this = Motion();
  settings_ = &settings;
  reference_ = held_ = point.at_rest();
}

template <class Space>
void Motion<Space>::move_on(double dt_s) {
  if (on_path()) follow_path(dt_s);
  bridge_time_s_ += dt_s;
  reference_ = base();
  bridging_ = bridging_ && bridge_time_s_ < bridge_.duration();
  if (bridging_) reference_ = Space::sum(reference_, bridge_.at(bridge_time_s_));
}

template <class Space>
void Motion<Space>::follow_path(double dt_s) {
  law_.step(path_, braking_ ? 0.0 : rate_, path_limits(), dt_s);
  starving_ = path_.open() && !braking_ && rate_ > 0.0 && law_.standing();
}

/// What the bridge leaves, which takes half of them at most.
template <class Space>
typename Space::Peaks Motion<Space>::path_limits() const {
  return Space::peaks(settings_->limits).reserved(bridging_ ? 0.5 : 1.0);
}

/// The path at its present time, or the point that is held. Leaves a path that has come to its end
/// or to rest.
template <class Space>
typename Space::Point Motion<Space>::base() {
  if (!on_path()) return held_;
  const bool ended = path_.ended(law_.s());
  const Point point = path_.at(law_.s()).at_rate(law_.rate(), law_.slope());
  if (!ended && !(braking_ && law_.standing())) return point;
  held_ = ended ? path_.end().at_rest() : point.at_rest();
  leave_path();
  // The position is held from now on; what the path fed forward is taken to zero.
  if (!bridging_) {
    reference_ = point.stopped();
    start_bridge(bridge_to(held_, 1.0));
  }
  return held_;
}

template <class Space>
void Motion<Space>::leave_path() {
  path_.leave();
  braking_ = starving_ = false;
  law_.stop();
}

template <class Space>
void Motion<Space>::forward(const Point& point) {
  leave_path();
  bridging_ = false;
  reference_ = held_ = point;
}

template <class Space>
Verdict Motion<Space>::shape(const Point& point) {
  const Point held = point.at_rest();
  const Bridge bridge = bridge_to(held, 1.0);
  const Verdict verdict = Space::judge_room(held, Space::use(held), bridge, settings_->limits);
  if (!verdict.ok()) return verdict;
  leave_path();
  held_ = held;
  start_bridge(bridge);
  return {};
}

/// Takes what is between the reference and a base that begins with `begin` to zero, with half of
/// `share` of the limits.
template <class Space>
typename Space::Bridge Motion<Space>::bridge_to(const Point& begin, double share) const {
  const typename Space::Difference difference = Space::difference(reference_, begin);
  return {difference, Space::bridge_time_s(difference, settings_->limits.scaled(share))};
}

template <class Space>
void Motion<Space>::start_bridge(const Bridge& bridge) {
  bridge_ = bridge;
  bridge_time_s_ = 0.0;
  bridging_ = true;
}

template <class Space>
Verdict Motion<Space>::follow(const Trajectory<Space>& trajectory,
                              const typename Space::Tolerance& tolerance, double elapsed_s) {
  Path<Space> path(trajectory, reference_);
  Verdict verdict = path.judge_terms(*settings_);
  if (verdict.ok()) verdict = meet(path, tolerance, elapsed_s);
  if (!verdict.ok()) return verdict;
  // Out of a motion the path is met at full rate; from rest any rate meets it. Where a path begins
  // with a step by nature, that is its own; the bridge ends the old motion only.
  PathLaw<Space> law;
  law.start(path, elapsed_s, reference_.standing() ? rate_ : 1.0, path_limits(),
            settings_->period_s);
  const double rate = law.rate();
  const Point begin = path.begin().at_rate(rate, 0.0);
  const typename Space::Use& use = path.use();
  const double left = 1.0 - std::max({use.velocity, use.acceleration, use.jerk});
  const Bridge bridge = bridge_to(begin, std::max(left, kLeastShare));
  verdict = Space::judge_room(begin, use, bridge, settings_->limits);
  if (!verdict.ok()) return verdict;
  start_bridge(bridge);
  path_ = path;
  braking_ = starving_ = false;
  law_ = law;
  return {};
}

/// Where a path is joined: on the way to its first waypoint, at it, or late.
template <class Space>
Verdict Motion<Space>::meet(Path<Space>& path, const typename Space::Tolerance& tolerance,
                            double elapsed_s) const {
  if (path.first_s() > elapsed_s) return path.lead_in(reference_, elapsed_s, 0, *settings_);
  if (elapsed_s > 0.0) return catch_up(path, elapsed_s);
  path.enter(0.0);
  Verdict verdict = Space::judge_near(path.begin(), reference_, tolerance);
  verdict.waypoint = 0;
  return verdict;
}

/// To the first waypoint that is as far ahead as a bridge to where the path is now would take.
template <class Space>
Verdict Motion<Space>::catch_up(Path<Space>& path, double elapsed_s) const {
  path.enter(elapsed_s);
  const double ahead_s = bridge_to(path.at(elapsed_s), 1.0).duration();
  return path.lead_in(reference_, elapsed_s, path.waypoint_from(elapsed_s + ahead_s), *settings_);
}

template <class Space>
void Motion<Space>::set_rate(double rate) {
  rate_ = rate;
}

template <class Space>
void Motion<Space>::brake() {
  braking_ = on_path();
}

template <class Space>
Verdict Motion<Space>::extend(const typename Space::Use& more) {
  return on_path() ? path_.extend(more, *settings_) : Verdict();
}

template class Motion<JointSpace>;
template class Motion<TaskSpace>;

}  // namespace tactus
