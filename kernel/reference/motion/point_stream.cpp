#include "kernel/reference/motion/point_stream.hpp"

#include <algorithm>
#include <cmath>

#include "kernel/reference/motion/fade.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {
namespace {

constexpr double kNearest_s = 1e-4;  // stamps closer together are those of no stream
// Least distance of points that are kept, against noise; those without stamps are also sent by
// programs that compute them in every cycle.
constexpr double kApartStamped_s = 0.03, kApart_s = 0.01;
constexpr double kLeastGain = 0.05;  // of the smoothed times
constexpr double kEarlyGain = 0.2;   // for an early point, which was delayed less than the others
// A jump fades in three periods, but slowly enough for the noise of fast streams.
constexpr double kFadePeriods = 3.0, kLeastFade_s = 0.12;
// How much faster than its usual speed a stream may be fitted; a parabola is by 4 at most.
constexpr double kMostUsual = 8.0;
constexpr double kMostFaded = 0.05;  // rad or m; a larger jump would be faster than limits allow
// Silence that ends a stream: three periods, but at least the delay of a busy sender, or, with
// stamps, of a network that loses and delays points, and at most kMostPatience_s more than one
// period.
constexpr double kSilentPeriods = 3.0, kSender_s = 0.02, kNetwork_s = 0.08, kMostPatience_s = 0.1;
constexpr int kMost = 1000;

/// Returns the difference t seconds later, with its second derivative constant.
template <class Difference>
Difference moved(const Difference& from, double t) {
  return {from.x + t * (from.dx + 0.5 * t * from.ddx), from.dx + t * from.ddx, from.ddx};
}

double median(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

}  // namespace

template <class Space>
double PointStream<Space>::patience_s() const {
  if (count_ < 2) return kSlowest_s;
  return std::clamp(kSilentPeriods * period_s_, stamped_ ? kNetwork_s : kSender_s,
                    period_s_ + kMostPatience_s);
}

template <class Space>
bool PointStream<Space>::moves(double now_s) const {
  return streams() && now_s - arrival_s_ <= patience_s();
}

template <class Space>
bool PointStream<Space>::silent(double now_s) const {
  return streams() && !moves(now_s);
}

template <class Space>
bool PointStream<Space>::continues(double now_s, double stamp_s) const {
  if (!recent(now_s) || (count_ > 1 && silent(now_s))) return false;
  if (stamped_ != (stamp_s != kNoStamp)) return false;
  const double distance_s = stamp_s - stamp_s_;
  return !stamped_ || (distance_s >= kNearest_s && distance_s <= kSlowest_s);
}

template <class Space>
void PointStream<Space>::keep_time(double now_s, double stamp_s) {
  if (!continues(now_s, stamp_s)) {
    count_ = 0;
    given_ = false;
    stamped_ = stamp_s != kNoStamp;
    time_s_ = now_s;
    period_s_ = 0.0;
  } else {
    const double gain = std::max(1.0 / count_, kLeastGain);
    period_s_ += gain * (now_s - arrival_s_ - period_s_);
    time_s_ += stamped_ ? stamp_s - stamp_s_ : period_s_;
    const double late_s = now_s - time_s_;
    time_s_ += std::max(1.0 / (count_ + 1), late_s < 0.0 ? kEarlyGain : kLeastGain) * late_s;
  }
  arrival_s_ = now_s;
}

/// Makes room for a point, this far from the newest, which it replaces if that is near the one
/// before.
template <class Space>
void PointStream<Space>::keep(double distance) {
  const auto more = static_cast<float>(distance);
  const double least_s = stamped_ ? kApartStamped_s : kApart_s;
  if (count_ >= kFitted && apart_s(0) + distance * unit_s() < least_s) {
    apart_[0] += more;
    return;
  }
  for (std::size_t i = kFitted - 1; i > 0; --i) points_[i] = points_[i - 1];
  for (std::size_t i = kFitted - 2; i > 0; --i) apart_[i] = apart_[i - 1];
  apart_[0] = more;
}

template <class Space>
typename Space::Difference PointStream<Space>::fit() const {
  const Point origin = points_[0].at_rest();
  const Difference newest = Space::difference(points_[0], origin);
  const Difference before = Space::difference(points_[1], origin);
  if (given_) {
    Difference now = {newest.x, newest.dx, 0.0 * newest.dx};
    if (count_ > 1) now.ddx = (newest.dx - before.dx) / apart_s(0);
    return now;
  }
  std::array<double, kFitted> times;
  times[0] = 0.0;
  for (std::size_t i = 1; i < kFitted; ++i) times[i] = times[i - 1] - apart_s(i - 1);
  const ParabolaFit weights = fit_parabola(times);
  Difference now = {0.0 * newest.x, 0.0 * newest.x, 0.0 * newest.x};
  std::array<Vector, kFitted> places;
  places[0] = newest.x;  // the origin
  for (std::size_t i = 1; i < kFitted; ++i) {
    places[i] = Space::difference(points_[i], origin).x;
    now.x += weights.x[i] * places[i];
    now.dx += weights.dx[i] * places[i];
    now.ddx += weights.ddx[i] * places[i];
  }
  bound(now, places);
  return now;
}

/// Bounds the fit by the usual speed between its points, the second of three; of points that go to
/// and fro, the second of the velocities. One step among them or one outlier, as of a leader that
/// was late, must not look like a fast motion, whose end would be felt as one the other way.
template <class Space>
void PointStream<Space>::bound(Difference& fit, const std::array<Vector, kFitted>& places) const {
  for (int k = 0; k < fit.x.size(); ++k) {
    const auto v = [&](std::size_t i) { return (places[i][k] - places[i + 1][k]) / apart_s(i); };
    const double a = v(0), b = v(1), c = v(2);
    const bool bends = (a - b) * (b - c) >= 0.0;  // one way, as a parabola does
    const double usual =
        bends ? median(std::abs(a), std::abs(b), std::abs(c)) : std::abs(median(a, b, c));
    const double dx = kMostUsual * usual, x = apart_s(0) * dx, ddx = dx / apart_s(0);
    fit.x[k] = std::clamp(fit.x[k], -x, x);
    fit.dx[k] = std::clamp(fit.dx[k], -dx, dx);
    fit.ddx[k] = std::clamp(fit.ddx[k], -ddx, ddx);
  }
}

template <class Space>
void PointStream<Space>::push(const Point& point, double now_s, double stamp_s) {
  const bool moved_before = moves(now_s);
  const Point old = moved_before ? target(now_s) : point;
  const bool replaces = now_s == arrival_s_ && stamp_s == stamp_s_;
  if (given_ && point.standing()) clear();
  if (count_ == 0 || !replaces) {
    const double distance = stamp_s != kNoStamp ? stamp_s - stamp_s_ : 1.0;
    keep_time(now_s, stamp_s);
    keep(count_ > 0 ? distance : 1.0);
    count_ = std::min(count_ + 1, kMost);
  }
  points_[0] = point;
  stamp_s_ = stamp_s;
  given_ = given_ || !point.standing();
  jump_ = {};
  if (!streams()) return;
  fit_ = fit();
  if (moved_before && count_ > kFitted) jump_ = Space::difference(old, predicted(now_s));
  if (jump_.x.cwiseAbs().maxCoeff() > kMostFaded) jump_ = {};
  jump_s_ = now_s;
}

template <class Space>
typename Space::Point PointStream<Space>::predicted(double now_s) const {
  return Space::sum(points_[0].stopped(), moved(fit_, now_s - time_s_));
}

template <class Space>
typename Space::Point PointStream<Space>::target(double now_s) const {
  const double T = std::max(kFadePeriods * period_s_, kLeastFade_s), x = now_s - jump_s_;
  const Point point = predicted(now_s);
  return jump_.zero() || !(x < T) ? point : Space::sum(point, faded(jump_, x / T, T));
}

template class PointStream<JointSpace>;
template class PointStream<TaskSpace>;

}  // namespace tactus
