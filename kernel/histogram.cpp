#include "kernel/histogram.hpp"

#include <algorithm>

namespace tactus {

// Values below 32 have a bucket each. Above, with 2^(k+5) <= value < 2^(k+6), the five bits after
// the leading one choose among the 32 buckets of doubling k.
std::size_t Histogram::bucket(std::uint64_t value_ns) {
  const std::uint64_t value = std::min(value_ns, kLongest_ns);
  std::size_t doubling = 0;
  while ((value >> doubling) >= 2 * kPerDoubling) ++doubling;  // bounded by kLongest_ns
  return doubling * kPerDoubling + static_cast<std::size_t>(value >> doubling);
}

double Histogram::middle(std::size_t bucket) {
  if (bucket < kPerDoubling) return static_cast<double>(bucket);
  const std::size_t doubling = bucket / kPerDoubling - 1;
  const std::uint64_t from = (kPerDoubling + bucket % kPerDoubling) << doubling;
  const std::uint64_t width = std::uint64_t{1} << doubling;
  return static_cast<double>(from) + 0.5 * static_cast<double>(width - 1);
}

void Histogram::add(std::uint64_t value_ns) {
  ++buckets_[bucket(value_ns)];
  ++count_;
  sum_ += value_ns;
  last_ = value_ns;
  if (value_ns < min_) min_ = value_ns;
  if (value_ns > max_) max_ = value_ns;
}

double Histogram::mean() const {
  return count_ > 0 ? static_cast<double>(sum_) / static_cast<double>(count_) : 0.0;
}

double Histogram::percentile(double fraction) const {
  if (count_ == 0) return 0.0;
  const double wanted = fraction * static_cast<double>(count_);
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    seen += buckets_[i];
    if (seen > 0 && static_cast<double>(seen) >= wanted) {
      return std::clamp(middle(i), static_cast<double>(min_), static_cast<double>(max_));
    }
  }
  return static_cast<double>(max_);
}

}  // namespace tactus
