// The words of describe(): every block and every section of a pipeline file lists its names once,
// in a
//
//   template <class Visitor> void describe(Visitor& visit)
//
// by calling on the visitor:
//   param(name, value, range, unit)   a setting: double, int, bool, JointVector or Vector3
//   text(name, value, meaning)        a setting that is a word or a path
//   choice(name, value, words)        a setting that is one of a fixed list of words
//   in(name, port), optional(name, port), out(name, port)
//   channel(name, pointer)            the mailboxes and stores through which references arrive
// The loader, the printed port list and the tests are all visitors of that one list.
#pragma once

#include <limits>

namespace tactus {

/// Closed interval of the values a setting may take. Non-finite values are outside every range.
struct Range {
  double lo, hi;
  /// False for NaN. [any]
  constexpr bool contains(double value) const {
    return value >= lo && value <= hi && value - value == 0.0;
  }
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr Range kAny = {-kInfinity, kInfinity};
inline constexpr Range kNonNegative = {0.0, kInfinity};
inline constexpr Range kPositive = {std::numeric_limits<double>::denorm_min(), kInfinity};

/// Initial value of a setting that has no default: the file must give it.
inline constexpr double kRequired = std::numeric_limits<double>::quiet_NaN();
inline constexpr int kRequiredInt = std::numeric_limits<int>::min();

}  // namespace tactus
