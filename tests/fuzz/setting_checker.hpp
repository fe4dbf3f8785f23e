// SettingChecker: a visitor that checks the settings read from a pipeline file against their
// ranges.
#pragma once

#include "kernel/core/names.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/text.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace tactus::fuzz {

class SettingChecker {
 public:
  template <class Settings>
  void section(const char*, Settings& settings) {
    settings.describe(*this);
  }
  template <class Number>
  void param(const char*, const Number& value, const Range& range, const char*) {
    if constexpr (std::is_arithmetic_v<Number>)
      MUST(range.contains(value));
    else
      for (int i = 0; i < value.size(); ++i) MUST(range.contains(value[i]));
  }
  template <class Number>
  void tunable(const char* key, const Number& value, const Range& range, const char* unit) {
    param(key, value, range, unit);
  }
  void optional(const char* key, double value, const Range& range, const char* unit) {
    if (!std::isnan(value)) param(key, value, range, unit);
  }
  template <int size>
  void optional(const char* key, const Eigen::Matrix<double, size, 1>& value, const Range& range,
                const char* unit) {
    if (!std::isnan(value[0])) param(key, value, range, unit);
  }
  void limit(const char*, const JointVector& value, const char*) {
    MUST((value.array() > 0.0).all() && value.allFinite());
  }
  template <std::size_t N>
  void text(const char*, const Text<N>&, const char*) {}
  void lines(const char*, const Hull& hull, const char*) {
    for (int i = 0; i < hull.count(); ++i) MUST(hull[i].allFinite());
  }
  void lines(const char* key, const LinkHulls& hulls, const char* meaning) {
    for (int i = 0; i < LinkHulls::kMost; ++i) lines(key, hulls[i], meaning);
  }
  template <class List>
  void lines(const char*, const List& list, const char*) {
    for (int i = 0; i < list.count(); ++i) MUST(list[i].line > 0 && list[i].joint < kDof);
  }
  template <class Enum>
  void choice(const char*, Enum value) {
    MUST(static_cast<std::size_t>(value) < kNames<Enum>.size());
  }
  template <Quantity Q>
  void optional(const char*, const In<Q>& port) {
    MUST(port.source != nullptr);
  }
  template <Quantity Q>
  void out(const char*, const Out<Q>&) {}
};

}  // namespace tactus::fuzz
