// Histogram: distribution of execution times in 1.6 kB of fixed memory. Every doubling of the value
// has 17 buckets, so a percentile is known to within 1/34, which is below 3 %. One writer, the
// cycle; any thread may read, without a lock and without disturbing it.
//
// The buckets reach to 67 ms; longer times count in the last bucket, and saturated() says how many
// there were. The extremes are exact up to 4.29 s. After 2^32 - 1 times, 49 days at 1 kHz, the
// histogram stops counting.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/core/published.hpp"

namespace tactus {

class Histogram {
 public:
  /// Adds one time, ns. [cyclic, one writer]
  void add(std::uint64_t value_ns);
  /// Removes all times. [init]
  void clear();

  std::uint32_t count() const { return count_; }
  std::uint32_t last() const { return last_; }
  std::uint32_t min() const { return count_ > 0 ? min_ : Published<std::uint32_t>(0); }
  std::uint32_t max() const { return max_; }
  /// Mean, ns, to seven digits. [any]
  double mean() const { return static_cast<double>(mean_); }
  /// Number of times beyond the last bucket. [any]
  std::uint32_t saturated() const { return saturated_; }
  /// Time that a fraction 0..1 of all values does not exceed, ns; 0 without values. [any]
  double percentile(double fraction) const;

 private:
  static constexpr std::uint64_t kPerDoubling = 17;
  static constexpr std::uint64_t kFirst = 4, kLast = 26;               // doublings: 16 ns to 67 ms
  static constexpr std::uint64_t kExact = std::uint64_t{1} << kFirst;  // below, one bucket each
  static constexpr std::uint64_t kLongest_ns = (std::uint64_t{1} << kLast) - 1;

  static std::size_t bucket(std::uint64_t value_ns);
  static double middle(std::size_t bucket);

  std::array<Published<std::uint32_t>, kExact + kPerDoubling*(kLast - kFirst)> buckets_;
  Published<std::uint32_t> count_, last_, max_, saturated_;
  Published<std::uint32_t> min_ = UINT32_MAX;
  Published<float> mean_;
  std::uint64_t sum_ = 0;  // used by the writer only
};

}  // namespace tactus
