#include "gateway/trajectory/smoothing/smoothing_spline.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace tactus {
namespace {

using Matrix3 = Eigen::Matrix3d;
using State = SmoothingSpline::State;
using Axes = SmoothingSpline::Axes;

constexpr double kUnknown = 1e4;    // variance of velocity and acceleration, unit of time 1/cutoff
constexpr double kCertain = 1e-12;  // variance of what is known
constexpr double kDoubt = 10.0;     // logarithm of the ratio of likelihoods that decides
constexpr int kUnjudged = 3;        // samples that a state without a history explains

/// The cutoff times the mean distance of samples.
double cutoff(int smoothness) {
  return 12.0 * std::pow(1.6, -smoothness);
}

/// The motion of a triple integrator in the time h.
Matrix3 motion(double h) {
  Matrix3 f = Matrix3::Identity();
  f(0, 1) = f(1, 2) = h;
  f(0, 2) = 0.5 * h * h;
  return f;
}

/// The variance that white noise of the given density, as jerk, adds to it.
Matrix3 driven(double h, double density) {
  const double h2 = h * h, h3 = h2 * h;
  Matrix3 q;
  q << h3 * h2 / 20.0, h2 * h2 / 8.0, h3 / 6.0,  //
      h2 * h2 / 8.0, h3 / 3.0, h2 / 2.0,         //
      h3 / 6.0, h2 / 2.0, h;
  return density * q;
}

/// Takes a measured value of one component into the state and its variance p. Returns its variance
/// before that, and the errors of the prediction.
double correct(State& state, Matrix3& p, int component, const Axes& measured, double variance,
               Axes& error) {
  const double s = p(component, component) + variance;
  const Eigen::Vector3d gain = p.col(component) / s;
  error = measured - state.row(component);
  state += gain * error;
  p -= Matrix3(gain * p.row(component));
  p = 0.5 * Matrix3(p + p.transpose());
  return s;
}

}  // namespace

/// The unit of time in which all entries of variances are of one size: 1 / cutoff, in seconds.
double SmoothingSpline::unit_s(int smoothness) const {
  const auto last = static_cast<std::size_t>(count) - 1;
  return (time_s[last] - time_s[0]) / static_cast<double>(last) / cutoff(smoothness);
}

/// Filters the samples; returns how unlikely they are, as the negative logarithm.
double SmoothingSpline::filter(int smoothness) {
  const double unit = unit_s(smoothness);
  Matrix3 p = Eigen::Vector3d(1.0, begins == Start::kAtRest ? 0.0 : kUnknown,
                              begins == Start::kAtRest ? 0.0 : kUnknown)
                  .asDiagonal();
  State state = State::Zero();
  state.row(0) = y[0];
  if (begins == Start::kGiven) {
    p.setZero();
    state = Eigen::Vector3d(1.0, unit, unit * unit).asDiagonal() * start;
  }
  states_[0] = state;
  Axes error, squares = Axes::Zero();
  double log_variances = 0.0;
  const auto n = static_cast<std::size_t>(count);
  for (std::size_t k = 1; k < n; ++k) {
    const double h = (time_s[k] - time_s[k - 1]) / unit;
    const Matrix3 f = steps_[k] = motion(h);
    const Matrix3 predicted = f * p * f.transpose() + driven(h, cutoff(smoothness));
    gains_[k - 1] = p * f.transpose() * predicted.inverse();
    p = predicted;
    state = State(f * state);
    const double variance = correct(state, p, 0, y[k], 1.0, error);
    if (k >= kUnjudged) {
      squares += Axes(error.cwiseProduct(error) / variance);
      log_variances += std::log(variance);
    }
    if (ends && k == n - 1) {
      correct(state, p, 1, Axes::Zero(), kCertain, error);
      correct(state, p, 2, Axes::Zero(), kCertain, error);
    }
    states_[k] = state;
  }
  return unlikelihood(squares, log_variances);
}

/// The unknown variances of the axes take their most likely values, but not less than the smallest.
double SmoothingSpline::unlikelihood(const Axes& squares, double log_variances) const {
  const double n = count - kUnjudged;
  double sum = 0.0;
  for (int axis = 0; axis < kMostAxes; ++axis) {
    const double least = least_error[axis] * least_error[axis];
    if (!(squares[axis] > 0.0)) continue;  // constant: any curve fits it
    sum += n * std::log(squares[axis] / n + least) + log_variances;
  }
  return sum;
}

/// Finds the likeliest smoothness for a given start; returns how unlikely the samples are with it.
double SmoothingSpline::least_unlikely(int& smoothness) {
  double least = filter(0);
  smoothness = 0;
  for (int tried = 1; tried <= kSmoothest; ++tried) {
    const double unlikely = filter(tried);
    if (!(unlikely < least)) continue;
    least = unlikely;
    smoothness = tried;
  }
  return least;
}

int SmoothingSpline::most_likely(bool from_rest) {
  int smoothness = 0, of_moving = 0;
  if (begins != Start::kUnknown) {
    least_unlikely(smoothness);
    return smoothness;
  }
  const double moving = least_unlikely(of_moving);
  begins = Start::kAtRest;
  if (least_unlikely(smoothness) <= moving + kDoubt || from_rest) return smoothness;
  begins = Start::kUnknown;
  return of_moving;
}

void SmoothingSpline::fit(int smoothness) {
  filter(smoothness);
  for (auto k = static_cast<std::size_t>(count) - 1; k-- > 0;)
    states_[k] += State(gains_[k] * (states_[k + 1] - State(steps_[k + 1] * states_[k])));
  const double unit = unit_s(smoothness);
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
    states_[k].row(1) /= unit;
    states_[k].row(2) /= unit * unit;
  }
}

}  // namespace tactus
