// RestWatch: whether an arm that is braked has come to rest, and whether it has taken too long.
#pragma once

#include <cstdint>

#include "kernel/types.hpp"

namespace tactus {

class RestWatch {
 public:
  static constexpr int kCycles = 10;  ///< at rest: so long no joint moves; one passes zero in one
  enum class Found : std::uint8_t { kNothing, kAtRest, kTooLong };

  /// A brake begins, which may take `longest` cycles to come to rest. [cyclic]
  void start(std::int64_t longest) {
    *this = {};
    longest_ = longest;
  }
  /// Tells once what has been found. `limit` is a joint velocity, rad/s; NaN is not rest. [cyclic]
  Found add(const JointVector& dq, double limit) {
    if (done_) return Found::kNothing;
    still_ = (dq.array().abs() <= limit).all() ? still_ + 1 : 0;
    at_rest_ = still_ >= kCycles;
    done_ = at_rest_ || ++cycles_ >= longest_;
    return at_rest_ ? Found::kAtRest : done_ ? Found::kTooLong : Found::kNothing;
  }
  bool at_rest() const { return at_rest_; }

 private:
  std::int64_t longest_ = 0, cycles_ = 0;
  int still_ = 0;
  bool at_rest_ = false, done_ = false;
};

}  // namespace tactus
