#include "kernel/core/histogram.hpp"

#include <algorithm>

#include "kernel/core/loop_bound.hpp"

namespace tactus {

// If 2^k <= value < 2^(k+1), the 17 buckets of doubling k divide its 2^k values evenly.
std::size_t Histogram::bucket(std::uint64_t value_ns) {
  const std::uint64_t value = std::min(value_ns, kLongest_ns);
  if (value < kExact) return static_cast<std::size_t>(value);
  std::uint64_t k = kFirst;
  LoopBound<22> doublings;  // up to kLast: the value is at most kLongest_ns
  while ((value >> k) > 1) {
    doublings.tick();
    ++k;
  }
  const std::uint64_t part = ((value - (std::uint64_t{1} << k)) * kPerDoubling) >> k;
  return static_cast<std::size_t>(kExact + kPerDoubling * (k - kFirst) + part);
}

/// Returns the middle between the first and the last whole number of a bucket.
double Histogram::middle(std::size_t bucket) {
  if (bucket < kExact) return static_cast<double>(bucket);
  const std::uint64_t index = bucket - kExact, k = kFirst + index / kPerDoubling;
  const auto edge = [k](std::uint64_t part) {  // the first value with at least this part
    return (std::uint64_t{1} << k) + ((part << k) + kPerDoubling - 1) / kPerDoubling;
  };
  const std::uint64_t first = edge(index % kPerDoubling), next = edge(index % kPerDoubling + 1);
  return 0.5 * static_cast<double>(first + next - 1);
}

void Histogram::add(std::uint64_t value_ns) {
  if (count_ == UINT32_MAX) return;
  const auto value = static_cast<std::uint32_t>(std::min<std::uint64_t>(value_ns, UINT32_MAX));
  last_ = value;
  if (value < min_) min_ = value;
  if (value > max_) max_ = value;
  if (value > kLongest_ns) ++saturated_;
  sum_ += value;
  mean_ = static_cast<float>(static_cast<double>(sum_) / (static_cast<double>(count_) + 1.0));
  ++buckets_[bucket(value)];
  ++count_;
}

void Histogram::clear() {
  for (Published<std::uint32_t>& bucket : buckets_) bucket = 0;
  count_ = last_ = max_ = saturated_ = 0;
  min_ = UINT32_MAX;
  mean_ = 0.0F;
  sum_ = 0;
}

/// Sums the buckets instead of using count_: while add() runs, they may be one ahead of it.
double Histogram::percentile(double fraction) const {
  std::uint64_t all = 0, seen = 0;
  for (const Published<std::uint32_t>& bucket : buckets_) all += bucket;
  if (all == 0) return 0.0;
  const double wanted = fraction * static_cast<double>(all);
  const auto lo = static_cast<double>(min_), hi = static_cast<double>(max_);
  for (std::size_t i = 0; i < buckets_.size(); ++i) {
    seen += buckets_[i];
    if (seen > 0 && static_cast<double>(seen) >= wanted) {
      if (i + 1 == buckets_.size() && saturated_ > 0) break;
      return std::min(std::max(middle(i), lo), hi);
    }
  }
  return hi;
}

}  // namespace tactus
