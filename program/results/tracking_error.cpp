#include "program/results/tracking_error.hpp"

#include <cmath>

namespace tactus {

void TrackingError::start(const Tracking& tracking) {
  *this = {};
  tracking_ = tracking;
  const QuantityInfo& quantity = info(tracking.reference->quantity);
  components_ = tracking.reference->quantity == Quantity::kPose ? 4 : quantity.recorded;
}

void TrackingError::add() {
  std::array<double, kMaxComponents> reference{}, measured{};
  flatten(*tracking_.reference, reference.data());
  flatten(*tracking_.measured, measured.data());
  if (tracking_.reference->quantity == Quantity::kPose) {
    const Pose& a = *static_cast<const Pose*>(tracking_.reference->value);
    const Pose& b = *static_cast<const Pose*>(tracking_.measured->value);
    reference[3] = a.r.angularDistance(b.r);
    measured[3] = 0.0;
    distance_ = larger_error(distance_, (a.p - b.p).norm());
  }
  ++count_;
  for (std::size_t i = 0; i < static_cast<std::size_t>(components_); ++i) {
    last_[i] = reference[i] - measured[i];
    squares_[i] += last_[i] * last_[i];
    max_[i] = larger_error(max_[i], std::abs(last_[i]));
  }
}

double TrackingError::rms(int component) const {
  if (count_ == 0) return 0.0;
  return std::sqrt(squares_[static_cast<std::size_t>(component)] / static_cast<double>(count_));
}

}  // namespace tactus
