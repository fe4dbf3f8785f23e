// SmoothingSpline: the smoothest curve through samples that have errors, of several axes at common
// times. It minimises
//
//   sum of (q(t_k) - y_k)^2 / sigma^2  +  integral of jerk^2 / s
//
// and is therefore a quintic between two samples, with continuous acceleration (a smoothing spline
// of order 3: Wahba, Improper priors, spline smoothing and the problem of guarding against model
// errors in regression, 1978). It is the mean of a triple integrator that white noise drives, given
// the samples, which a Kalman filter and the smoother of Rauch, Tung and Striebel (1965) find in a
// time proportional to their number. Only the ratio of s and sigma^2 matters. It is given as the
// cutoff, (s / (sigma^2 h))^(1/6), the angular frequency of which half is kept where the samples
// are h apart; that of the maximum likelihood tells errors from motion without a setting.
#pragma once

#include <array>

#include <Eigen/Core>

namespace tactus {

class SmoothingSpline {
 public:
  static constexpr int kMostSamples = 1024, kMostAxes = 7;
  using Axes = Eigen::Matrix<double, 1, kMostAxes>;
  /// Position, velocity and acceleration, by row.
  using State = Eigen::Matrix<double, 3, kMostAxes>;

  /// Knowledge of the first sample.
  enum class Start {
    kUnknown,  ///< its position, as precisely as any other
    kAtRest,   ///< that the motion begins there
    kGiven,    ///< all: `start`
  };

  // The samples. Axes that are not used are zero.
  int count = 0;
  std::array<double, kMostSamples> time_s;  ///< increasing
  std::array<Axes, kMostSamples> y;
  Axes least_error = Axes::Zero();  ///< of each axis, as a standard deviation; > 0
  Start begins = Start::kUnknown;
  State start;
  bool ends = false;  ///< the motion ends at the last sample

  /// The smoothness of a curve: 0 goes through all samples, with a cutoff of 12 over their mean
  /// distance. In each step the cutoff is 1.6 times less; with the last the curve depends on fewer
  /// than 250 samples on either side.
  static constexpr int kSmoothest = 14;

  /// Returns the smoothness of the maximum likelihood. If the start of the motion is unknown, also
  /// decides whether it begins at rest: if it must, or unless that is unlikely. Needs eight
  /// samples. [any, not cyclic]
  int most_likely(bool from_rest);
  /// Fits the curve. [any, not cyclic]
  void fit(int smoothness);
  /// State of the curve at a sample, after fit(). [any]
  const State& at(int sample) const { return states_[static_cast<std::size_t>(sample)]; }

 private:
  using Matrix3 = Eigen::Matrix3d;

  double unit_s(int smoothness) const;
  double filter(int smoothness);
  double least_unlikely(int& smoothness);
  double unlikelihood(const Axes& squares, double log_variances) const;

  std::array<State, kMostSamples> states_;   // filtered, then smoothed
  std::array<Matrix3, kMostSamples> gains_;  // of the smoother
  std::array<Matrix3, kMostSamples> steps_;  // of the motion, from a sample to the next
};

}  // namespace tactus
