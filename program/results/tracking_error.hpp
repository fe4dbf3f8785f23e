// TrackingError: root mean square, largest and last difference between a reference and its
// measurement.
#pragma once

#include <cmath>

#include "kernel/pipeline/recorder.hpp"

namespace tactus {

/// Returns the larger error; one that is not a number outlasts every other. [any]
inline double larger_error(double a, double b) {
  return std::isnan(a) || b <= a ? a : b;
}

class TrackingError {
 public:
  /// Joint quantities have one error per joint; poses have x, y, z (m) and the angle between the
  /// orientations (rad).
  void start(const Tracking& tracking);
  /// Adds the present values of the two ports.
  void add();

  const Tracking& tracking() const { return tracking_; }
  int components() const { return components_; }
  double rms(int component) const;
  double max(int component) const { return max_[static_cast<std::size_t>(component)]; }
  double last(int component) const { return last_[static_cast<std::size_t>(component)]; }
  /// Largest distance of the tip from its reference, m; 0 unless poses are compared.
  double distance() const { return distance_; }

 private:
  static constexpr std::size_t kMaxComponents = 16;
  static_assert(kDof <= static_cast<int>(kMaxComponents));

  Tracking tracking_;
  int components_ = 0;
  std::int64_t count_ = 0;
  std::array<double, kMaxComponents> squares_{}, max_{}, last_{};
  double distance_ = 0.0;
};

}  // namespace tactus
