// PointStamps: when the newest points of a stream were made, if that is known.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/core/streams.hpp"
#include "kernel/reference/motion/parabola_fit.hpp"

namespace tactus {

template <bool streams = kStreams>
class PointStamps {
 public:
  /// True if the points have stamps.
  bool given() const { return given_; }
  /// Forgets all; the points that follow have stamps, or none.
  void begin(bool given) { given_ = given; }
  /// Makes room for a newer one.
  void shift() {
    for (std::size_t i = kFitted - 1; i > 0; --i) stamps_s_[i] = stamps_s_[i - 1];
  }
  void set_newest(double stamp_s) { stamps_s_[0] = stamp_s; }
  /// Returns by how much this stamp is later than the newest, s.
  double since_newest_s(double stamp_s) const { return stamp_s - stamps_s_[0]; }
  /// Returns by how much a point is older than the newest, s.
  double age_s(std::size_t point) const { return stamps_s_[0] - stamps_s_[point]; }

 private:
  std::array<double, kFitted> stamps_s_ = {};  // newest first
  bool given_ = false;
};

/// Points of a board without streams have no stamps.
template <>
class PointStamps<false> {
 public:
  static constexpr bool given() { return false; }
  void begin(bool) {}
  void shift() {}
  void set_newest(double) {}
  static double since_newest_s(double) { return 0.0; }
  static double age_s(std::size_t) { return 0.0; }
};

}  // namespace tactus
