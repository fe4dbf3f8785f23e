#include "gateway/trajectory/smoothed_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "kernel/reference/space/judge_channels.hpp"

namespace tactus {
namespace {

using Axes = SmoothingSpline::Axes;

/// Half of a digit counts as this, rad or m, where fewer were written.
constexpr double kCoarsest = 0.005;
/// Given velocities may differ by so many tolerances of the position per second.
constexpr double kVelocity_per_s = 20.0;
/// Largest turn from the origin of a chart, rad; at 2 pi it ends.
constexpr double kLargestTurn = 2.5;
constexpr double kRounding = 1e-10;  // rad or m
constexpr const char* kNoCurve = "no smooth curve is near enough";

template <int N>
Axes axes(const Eigen::Matrix<double, N, 1>& vector) {
  Axes all = Axes::Zero();
  all.template head<N>() = vector.transpose();
  return all;
}

Axes position_of(const JointSpace::Point& half_units) {
  return axes<kDof>(half_units.q);
}
Axes position_of(const TaskSpace::Point& half_units) {
  Axes all = Axes::Zero();
  all.head<3>() = half_units.x.p.transpose();
  all.segment<3>(3).setConstant(4.0 * half_units.x.r.coeffs().maxCoeff());  // of a quaternion
  return all;
}
Axes velocity_of(const JointSpace::Point& point) {
  return axes<kDof>(point.dq);
}
Axes velocity_of(const TaskSpace::Point& point) {
  return axes<6>(point.v);
}

Axes tolerances(const JointSpace&, const SmoothingTolerance& tolerance) {
  Axes all = Axes::Constant(tolerance.rad);
  for (int i = 0; i < kDof; ++i)
    if (is_prismatic<Robot>(i)) all[i] = tolerance.m;
  return all;
}
Axes tolerances(const TaskSpace&, const SmoothingTolerance& tolerance) {
  Axes all = Axes::Constant(tolerance.rad);
  all.head<3>().setConstant(tolerance.m);
  return all;
}

void note_moved(const JointSpace&, const Axes& moved, SmoothingTolerance& most) {
  for (int i = 0; i < kDof; ++i) {
    double& of_kind = is_prismatic<Robot>(i) ? most.m : most.rad;
    of_kind = std::max(of_kind, moved[i]);
  }
}
void note_moved(const TaskSpace&, const Axes& moved, SmoothingTolerance& most) {
  most.m = std::max(most.m, moved.head<3>().maxCoeff());
  most.rad = std::max(most.rad, moved.segment<3>(3).maxCoeff());
}

/// True if the chart of the axes has this place.
bool in_chart(const Axes&, const JointSpace&) {
  return true;
}
bool in_chart(const Axes& place, const TaskSpace&) {
  return place.segment<3>(3).norm() < kLargestTurn;
}

}  // namespace

Message describe(const SmoothingTolerance& moved) {
  char text[64] = "";
  if (moved.m > 0.0)
    std::snprintf(text, sizeof text, "smoothed, by up to %.2g m and %.2g rad", moved.m, moved.rad);
  else if (moved.rad > 0.0)
    std::snprintf(text, sizeof text, "smoothed, by up to %.2g rad", moved.rad);
  return Message(text);
}

template <class Space>
bool SmoothedReader<Space>::restart(const Smoothing& smoothing, CsvError& error) {
  smoothing_ = smoothing;
  moved_ = {};
  at_end_ = begun_ = false;
  run_ups_ = 0;
  count_ = next_ = ready_ = 0;
  // The digits of a column are known when all of its numbers were read.
  RowResult taken = smooths() ? RowResult::kWaypoint : RowResult::kEnd;
  while (taken == RowResult::kWaypoint) taken = reader_.next(rows_[0], error);
  return taken == RowResult::kEnd && reader_.rewind(error);
}

template <class Space>
bool SmoothedReader<Space>::rewind(CsvError& error) {
  const SmoothingTolerance moved = moved_;
  const bool good = restart(smoothing_, error);
  moved_ = moved;
  return good;
}

template <class Space>
Fields SmoothedReader<Space>::fields() const {
  constexpr int kDerivatives = kVelocityField | kAccelerationField;
  return static_cast<Fields>(reader_.fields() | (smooths() ? kDerivatives : 0));
}

template <class Space>
RowResult SmoothedReader<Space>::next(Waypoint<Space>& waypoint, CsvError& error, int wait_ms) {
  if (!smooths()) {
    const RowResult taken = reader_.next(waypoint, error, wait_ms);
    line_ = lines().line();
    return taken;
  }
  if (next_ == ready_) {
    if (at_end_ && ready_ == count_) return RowResult::kEnd;
    if (!fit_more(error)) return RowResult::kRefused;
  }
  const bool begins = !begun_;
  begun_ = true;
  if (begins && run_up(waypoint)) return RowResult::kWaypoint;
  waypoint = row(next_);
  waypoint.point = point(next_);
  line_ = lines_[static_cast<std::size_t>(next_++)];
  return RowResult::kWaypoint;
}

/// Writes the waypoint before the first one where a motion that begins at a velocity begins to run
/// up to it, from rest. Without it one quintic would lead from wherever the arm is to that
/// velocity, and swing out the farther the longer it may take. False: from rest, or too early for a
/// run-up.
template <class Space>
bool SmoothedReader<Space>::run_up(Waypoint<Space>& waypoint) {
  constexpr double kShare = 0.5, kLeast_s = 0.05;  // of the limits
  const typename Space::Point first = point(0), rest = first.at_rest();
  typename Space::Difference state = Space::difference(first, rest);
  // The way of one quintic to that velocity and acceleration swings out by less than this.
  const Axes swing =
      row(0).time_s * (0.1 * axes(state.dx) + 0.01 * row(0).time_s * axes(state.ddx));
  if ((swing.cwiseAbs().array() <= tolerances(Space(), smoothing_.tolerance).array()).all())
    return false;
  double time_s = kLeast_s;
  for (std::size_t c = 0; c < limits_.v.size(); ++c) {
    const auto axis = static_cast<Eigen::Index>(c) * Space::kChannelSize;
    const double v = length<Space::kChannelSize>(&state.dx[axis]);
    const double a = length<Space::kChannelSize>(&state.ddx[axis]);
    time_s = std::max({time_s, 1.5 * v / (kShare * limits_.a[c]), 2.0 * a / (kShare * limits_.j[c]),
                       std::sqrt(6.0 * v / (kShare * limits_.j[c]))});
  }
  if (!(row(0).time_s >= 2.0 * time_s)) return false;
  // The velocity is a cubic, from rest to that of the first waypoint and its acceleration.
  state.x = -time_s * (0.5 * state.dx - time_s / 12.0 * state.ddx);
  state.dx.setZero();
  state.ddx.setZero();
  waypoint = row(0);
  waypoint.time_s -= time_s;
  waypoint.point = Space::sum(rest, state);
  Space::add_effort(waypoint.point, Space::effort_beyond(row(0).point, waypoint.point), 1.0, 0.0);
  line_ = lines_[0];
  run_ups_ = 1;
  return true;
}

/// Moves the window on, so that it begins with the last row that was handed out.
template <class Space>
bool SmoothedReader<Space>::fit_more(CsvError& error) {
  using Start = SmoothingSpline::Start;
  if (ready_ == 0) {
    spline_.begins = Start::kUnknown;
  } else {
    const auto from = static_cast<std::size_t>(ready_ - 1);
    const typename Space::Point last = point(ready_ - 1);
    origin_ = last.at_rest();
    const auto state = Space::difference(last, origin_);
    spline_.start.setZero();
    spline_.start.row(1) = axes<Space::Difference::Vector::RowsAtCompileTime>(state.dx);
    spline_.start.row(2) = axes<Space::Difference::Vector::RowsAtCompileTime>(state.ddx);
    spline_.begins = Start::kGiven;
    const auto end = rows_.begin() + count_;
    std::copy(rows_.begin() + from, end, rows_.begin());
    std::copy(lines_.begin() + from, lines_.begin() + count_, lines_.begin());
    count_ -= static_cast<int>(from);
  }
  if (!read_window(error)) return false;
  if (spline_.begins == Start::kUnknown) {
    origin_ = row(0).point.at_rest();
  }
  next_ = spline_.begins == Start::kGiven ? 1 : 0;
  prepare();
  const bool enough = spline_.begins == Start::kGiven || count_ >= kFewest;
  if (enough && spline_.count > next_ && fit()) return true;
  error = {};
  error.line = lines_[0];
  error.reason = Message(kNoCurve);
  return false;
}

template <class Space>
bool SmoothedReader<Space>::read_window(CsvError& error) {
  while (count_ < kMost && !at_end_) {
    const auto place = static_cast<std::size_t>(count_);
    const RowResult taken = reader_.next(rows_[place], error);
    if (taken == RowResult::kRefused) return false;
    at_end_ = taken != RowResult::kWaypoint;
    lines_[place] = lines().line();
    count_ += at_end_ ? 0 : 1;
  }
  return true;
}

/// Gives the rows of the window to the spline, as far as one chart has them.
template <class Space>
void SmoothedReader<Space>::prepare() {
  constexpr int kSize = Space::Difference::Vector::RowsAtCompileTime;
  const Axes unit = position_of(reader_.half_units(row(0)).point);
  spline_.least_error = unit.cwiseMin(kCoarsest) / std::sqrt(3.0) + Axes::Constant(kRounding);
  spline_.count = 0;
  for (; spline_.count < count_; ++spline_.count) {
    const auto k = static_cast<std::size_t>(spline_.count);
    const Axes place = axes<kSize>(Space::difference(rows_[k].point.at_rest(), origin_).x);
    if (!in_chart(place, Space())) break;
    spline_.time_s[k] = rows_[k].time_s;
    spline_.y[k] = place;
  }
  const bool whole = at_end_ && spline_.count == count_;
  spline_.ends = whole;
  ready_ = whole ? count_ : std::max(spline_.count - kAhead, (spline_.count + next_ + 1) / 2);
}

/// Fits the likeliest curve or the smoother one that is requested, or the next sharper one that is
/// near enough.
template <class Space>
bool SmoothedReader<Space>::fit() {
  const bool first = spline_.begins == SmoothingSpline::Start::kUnknown;
  const bool left_at_once = first && !(row(0).time_s > 0.0);  // and therefore from rest
  const int likely = spline_.count < kFewest ? 0 : spline_.most_likely(left_at_once);
  const int wanted = std::min(likely + smoothing_.rounding, SmoothingSpline::kSmoothest);
  for (int smoothness = wanted; smoothness >= 0; --smoothness) {
    spline_.fit(smoothness);
    const SmoothingTolerance before = moved_;
    int sample = next_;
    while (sample < ready_ && near(sample)) ++sample;
    if (sample == ready_) return true;
    moved_ = before;
  }
  return false;
}

/// True if the curve at a sample, and on the way to it, is within what is allowed.
template <class Space>
bool SmoothedReader<Space>::near(int sample) {
  const typename Space::Point smooth = point(sample);
  const Axes most = allowed(sample, smooth);
  const auto k = static_cast<std::size_t>(sample);
  const SmoothingSpline::State& to = spline_.at(sample);
  const Axes moved = (to.row(0) - spline_.y[k]).cwiseAbs();
  note_moved(Space(), moved, moved_);
  if (!(moved.array() <= most.array()).all()) return false;
  if (reader_.fields() & kVelocityField) {
    const Axes half = velocity_of(reader_.half_units(row(sample)).point);
    const Axes other = (velocity_of(smooth) - velocity_of(row(sample).point)).cwiseAbs();
    const Axes far = half + kVelocity_per_s * tolerances(Space(), smoothing_.tolerance);
    return (other.array() <= far.array()).all();
  }
  if (sample == 0) return true;
  const SmoothingSpline::State& from = spline_.at(sample - 1);
  const double h = spline_.time_s[k] - spline_.time_s[k - 1];
  const Axes sag =
      5.0 / 32.0 * h * (from.row(1) - to.row(1)) + h * h / 64.0 * (from.row(2) + to.row(2));
  return (sag.cwiseAbs().array() <= most.array()).all();
}

/// By how much a sample may be moved.
template <class Space>
Axes SmoothedReader<Space>::allowed(int sample, const typename Space::Point& smooth) const {
  const Waypoint<Space> half = reader_.half_units(row(sample));
  return position_of(half.point).cwiseMin(kCoarsest) + tolerances(Space(), smoothing_.tolerance) +
         half.time_s * velocity_of(smooth).cwiseAbs();
}

/// The point of the curve at a sample, with the effort that was given; at the end at rest.
template <class Space>
typename Space::Point SmoothedReader<Space>::point(int sample) const {
  constexpr int kSize = Space::Difference::Vector::RowsAtCompileTime;
  const SmoothingSpline::State& state = spline_.at(sample);
  const bool last = spline_.ends && sample == spline_.count - 1;
  typename Space::Difference place;
  place.x = state.row(0).template head<kSize>().transpose();
  if (!last) {
    place.dx = state.row(1).template head<kSize>().transpose();
    place.ddx = state.row(2).template head<kSize>().transpose();
  }
  typename Space::Point smooth = Space::sum(origin_, place);
  Space::add_effort(smooth, Space::effort_beyond(row(sample).point, smooth), 1.0, 0.0);
  return smooth;
}

template class SmoothedReader<JointSpace>;
template class SmoothedReader<TaskSpace>;

}  // namespace tactus
