// The calls that describe() makes. Every block and every section of a pipeline file lists its names
// once, in a
//
//   template <class Visitor> void describe(Visitor& visit)
//
// which calls these functions of the visitor:
//   param(name, value, range, unit)   a setting: double, int, JointVector or Vector3
//   tunable(name, value, range, unit) one that may change while the pipeline runs: JointVector,
//                                     Vector3 or double. A block with one has retune()
//   optional(name, value, range, unit)  a setting that may be left out and is NaN then: double or
//                                     Vector3
//   limit(name, value, unit)          a limit per joint, which the file may tighten but not widen
//   text(name, value, meaning)        a setting that is a word or a path
//   lines(name, list, meaning)        a setting that may be given several times, each time a line
//   choice(name, value)               a setting that is one of an enumeration's names (names.hpp)
//   in(name, port), optional(name, port), out(name, port)
//   channel(name, pointer)            the mailboxes and stores through which references arrive
// A pipeline, and a board, list the sections of a file that are not blocks in the same way:
//   section(name, settings)           a section; its keys are in settings.describe()
// The loader, the printed port list and the tests are visitors of this one list.
#pragma once

#include <limits>

namespace tactus {

/// Closed interval of the values a setting may take. It never contains a non-finite value.
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

/// Initial value of a setting without default: the file must give it.
inline constexpr double kRequired = std::numeric_limits<double>::quiet_NaN();
inline constexpr int kRequiredInt = std::numeric_limits<int>::min();

}  // namespace tactus
