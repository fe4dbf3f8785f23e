// RestWatch: decides whether the arm is at rest. It judges blocks of cycles by their mean velocity,
// so that noise neither hides rest nor ends it, and by their largest, so that a reversing joint,
// whose mean is zero too, is not at rest.
#pragma once

#include <cstdint>

#include "kernel/core/types.hpp"

namespace tactus {

class RestWatch {
 public:
  static constexpr int kCycles = 10;          ///< of a block
  static constexpr double kMostOfMean = 4.0;  ///< largest velocity in a block at rest
  static constexpr double kMoved = 2.0;       ///< smallest mean of a block that has left rest
  enum class Result : std::uint8_t { kNothing, kAtRest, kTooLong, kMoved };

  /// Begins the watch of a brake, which may take `longest` cycles to come to rest. [cyclic]
  void start(std::int64_t longest) {
    *this = {};
    longest_ = longest;
  }
  /// Takes the velocities of a cycle, rad/s; the arm is at rest within `limit`. Returns kAtRest or
  /// kTooLong once, then kMoved for every block in which the arm has moved again. NaN is motion.
  /// [cyclic]
  Result add(const JointVector& dq, double limit) {
    sum_ += dq;
    within_ = within_ && (dq.array().abs() <= kMostOfMean * limit).all();
    ++cycles_;
    if (cycles_ % kCycles != 0)
      return !done_ && cycles_ >= longest_ ? end(Result::kTooLong) : Result::kNothing;
    const JointVector mean = sum_ / kCycles;
    still_ = within_ && (mean.array().abs() <= limit).all();
    const bool moved = !(mean.array().abs() <= kMoved * limit).all();
    sum_.setZero();
    within_ = true;
    if (done_) return at_rest_ && moved ? Result::kMoved : Result::kNothing;
    at_rest_ = still_;
    if (still_) return end(Result::kAtRest);
    return cycles_ >= longest_ ? end(Result::kTooLong) : Result::kNothing;
  }
  /// True if the last whole block was at rest.
  bool still() const { return still_; }
  /// True if the brake has come to rest.
  bool at_rest() const { return at_rest_; }

 private:
  Result end(Result result) {
    done_ = true;
    return result;
  }

  std::int64_t longest_ = 0, cycles_ = 0;
  JointVector sum_ = JointVector::Zero();
  bool within_ = true, still_ = false, at_rest_ = false, done_ = false;
};

}  // namespace tactus
