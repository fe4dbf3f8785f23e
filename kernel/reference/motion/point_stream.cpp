#include "kernel/reference/motion/point_stream.hpp"

#include <algorithm>

#include "kernel/reference/motion/fade.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {
namespace {

constexpr double kSlowest_s = 0.25;   // points farther apart are no stream
constexpr double kLeastGain = 0.05;   // of the smoothed times
constexpr double kEarlyGain = 0.2;    // for an early point, which was delayed less than the others
constexpr double kFadePeriods = 3.0;  // duration of the fading of a jump
// Silence that ends a stream: three periods, but at least the delay of a busy sender and at most
// kMostPatience_s more than one period.
constexpr double kSilentPeriods = 3.0, kLeastPatience_s = 0.02, kMostPatience_s = 0.1;
constexpr int kMost = 1000;

/// Returns the difference t seconds later, with its second derivative constant.
template <class Difference>
Difference moved(const Difference& from, double t) {
  return {from.x + t * (from.dx + 0.5 * t * from.ddx), from.dx + t * from.ddx, from.ddx};
}

}  // namespace

template <class Space>
double PointStream<Space>::patience_s() const {
  if (count_ < 2) return kSlowest_s;
  return std::clamp(kSilentPeriods * period_s_, kLeastPatience_s, period_s_ + kMostPatience_s);
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
void PointStream<Space>::keep_time(double now_s) {
  const double interval = now_s - arrival_s_;
  if (count_ == 0 || interval > kSlowest_s || (count_ > 1 && silent(now_s))) {
    count_ = 0;
    given_ = false;
    time_s_ = now_s;
    period_s_ = 0.0;
  } else {
    const double gain = std::max(1.0 / count_, kLeastGain);
    period_s_ += gain * (interval - period_s_);
    time_s_ += period_s_;
    const double late_s = now_s - time_s_;
    time_s_ += std::max(1.0 / (count_ + 1), late_s < 0.0 ? kEarlyGain : kLeastGain) * late_s;
  }
  arrival_s_ = now_s;
}

template <class Space>
typename Space::Difference PointStream<Space>::fit() const {
  const Point origin = points_[0].at_rest();
  std::array<Difference, kFitted> p;
  for (std::size_t i = 0; i < kFitted; ++i) p[i] = Space::difference(points_[i], origin);
  const double D = period_s_;
  if (given_) {
    Difference now = {p[0].x, p[0].dx, 0.0 * p[0].dx};
    if (count_ > 1) now.ddx = (p[0].dx - p[1].dx) / D;
    return now;
  }
  return {(3.0 * p[1].x - 3.0 * p[2].x + p[3].x) / 20.0,
          (-13.0 * p[1].x - 17.0 * p[2].x + 9.0 * p[3].x) / (20.0 * D),
          (p[3].x - p[1].x - p[2].x) / (2.0 * D * D)};
}

template <class Space>
void PointStream<Space>::push(const Point& point, double now_s) {
  const bool moved_before = moves(now_s);
  const Point old = moved_before ? target(now_s) : point;
  if (count_ == 0 || now_s > arrival_s_) {  // else the point replaces the newest
    keep_time(now_s);
    for (std::size_t i = kFitted - 1; i > 0; --i) points_[i] = points_[i - 1];
    count_ = std::min(count_ + 1, kMost);
  }
  points_[0] = point;
  given_ = given_ || !point.standing();
  jump_ = {};
  if (!streams()) return;
  fit_ = fit();
  if (moved_before && count_ > kFitted) jump_ = Space::difference(old, predicted(now_s));
  jump_s_ = now_s;
}

template <class Space>
typename Space::Point PointStream<Space>::predicted(double now_s) const {
  return Space::sum(points_[0].stopped(), moved(fit_, now_s - time_s_));
}

template <class Space>
typename Space::Point PointStream<Space>::target(double now_s) const {
  const double T = kFadePeriods * period_s_, x = now_s - jump_s_;
  const Point point = predicted(now_s);
  return jump_.zero() || !(x < T) ? point : Space::sum(point, faded(jump_, x / T, T));
}

template class PointStream<JointSpace>;
template class PointStream<TaskSpace>;

}  // namespace tactus
