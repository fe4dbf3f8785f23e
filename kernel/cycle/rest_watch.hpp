// RestWatch: decides whether the arm is at rest. It judges blocks of cycles by their mean velocity,
// so that noise neither hides rest nor ends it, and by their largest, so that a reversing joint,
// whose mean is zero too, is not at rest. Only several such blocks in a row are rest: the turning
// point of a slow swing of the loop is as long as one.
#pragma once

#include <cstdint>

#include "kernel/core/types.hpp"
#include "kernel/pipeline/settings.hpp"

namespace tactus {

class RestWatch {
 public:
  static constexpr int kCycles = ExecutiveSection::kRestBlock;  ///< of a block
  static constexpr double kMostOfMean = 4.0;  ///< largest velocity in a block at rest
  static constexpr double kMoved = 2.0;       ///< smallest mean of a block that has left rest
  enum class Result : std::uint8_t { kNothing, kAtRest, kTooLong, kMoved };

  /// Begins the watch of a brake, which may take `longest` cycles to come to rest, with `blocks`
  /// in a row. [cyclic]
  void start(std::int32_t longest, std::uint16_t blocks) {
    *this = {};
    left_ = longest;
    blocks_ = blocks;
  }
  /// Takes the velocities of a cycle, rad/s; a block is at rest within `limit`. Returns kAtRest or
  /// kTooLong once, then kMoved for every block in which the arm has moved again. NaN is motion.
  /// [cyclic]
  Result add(const JointVector& dq, double limit) {
    sum_ += dq;
    within_ = within_ && (dq.array().abs() <= kMostOfMean * limit).all();
    if (left_ > 0) --left_;
    if (++cycles_ < kCycles) return !done_ && left_ == 0 ? end(Result::kTooLong) : Result::kNothing;
    const JointVector mean = sum_ / kCycles;
    const bool quiet = within_ && (mean.array().abs() <= limit).all();
    const bool moved = !(mean.array().abs() <= kMoved * limit).all();
    if (!quiet)
      quiet_ = 0;
    else if (quiet_ < blocks_)
      ++quiet_;
    sum_.setZero();
    within_ = true;
    cycles_ = 0;
    if (done_) return at_rest_ && moved ? Result::kMoved : Result::kNothing;
    at_rest_ = still();
    if (at_rest_) return end(Result::kAtRest);
    return left_ == 0 ? end(Result::kTooLong) : Result::kNothing;
  }
  /// True if the last whole blocks were at rest, as many as the watch takes.
  bool still() const { return quiet_ >= blocks_; }
  /// True if the brake has come to rest.
  bool at_rest() const { return at_rest_; }

 private:
  Result end(Result result) {
    done_ = true;
    return result;
  }

  JointVector sum_ = JointVector::Zero();
  std::int32_t left_ = 0;  // cycles until the brake takes too long
  std::uint16_t blocks_ = 1, quiet_ = 0;
  std::uint8_t cycles_ = 0;  // of the present block
  bool within_ = true, at_rest_ = false, done_ = false;
};

}  // namespace tactus
