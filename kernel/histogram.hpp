// Histogram: execution times in fixed memory. Buckets grow with the value, 32 to every doubling, so
// that any percentile is known to within 1.6 %.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tactus {

class Histogram {
 public:
  /// Adds one time, ns. [cyclic]
  void add(std::uint64_t value_ns);

  std::uint64_t count() const { return count_; }
  std::uint64_t last() const { return last_; }
  std::uint64_t min() const { return count_ > 0 ? min_ : 0; }
  std::uint64_t max() const { return max_; }
  double mean() const;
  /// The time that a fraction 0..1 of all values does not exceed, ns; 0 if there are none. [any]
  double percentile(double fraction) const;

 private:
  static constexpr std::size_t kPerDoubling = 32;
  static constexpr std::size_t kDoublings = 31;
  // 2^35 - 1 ns = 34 s; longer counts as that in percentiles.
  static constexpr std::uint64_t kLongest_ns = (std::uint64_t{kPerDoubling} << kDoublings) / 2 - 1;

  static std::size_t bucket(std::uint64_t value_ns);
  static double middle(std::size_t bucket);

  std::array<std::uint64_t, kPerDoubling * kDoublings> buckets_{};
  std::uint64_t count_ = 0, sum_ = 0, last_ = 0, max_ = 0;
  std::uint64_t min_ = UINT64_MAX;
};

}  // namespace tactus
