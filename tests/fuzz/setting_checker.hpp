// SettingChecker: the visitor that holds what was read from a pipeline file against the ranges it
// was read by.
#pragma once

#include "kernel/port.hpp"
#include "kernel/text.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace tactus::fuzz {

class SettingChecker {
 public:
  template <class Number>
  void param(const char*, const Number& value, const Range& range, const char*) {
    if constexpr (std::is_arithmetic_v<Number>)
      MUST(range.contains(value));
    else
      for (int i = 0; i < value.size(); ++i) MUST(range.contains(value[i]));
  }
  void limit(const char*, const JointVector& value, const char*) {
    MUST((value.array() > 0.0).all() && value.allFinite());
  }
  template <std::size_t N>
  void text(const char*, const Text<N>&, const char*) {}
  template <class Enum, std::size_t N>
  void choice(const char*, Enum value, const std::array<const char*, N>&) {
    MUST(static_cast<std::size_t>(value) < N);
  }
  template <Quantity Q>
  void optional(const char*, const In<Q>& port) {
    MUST(port.source != nullptr);
  }
  template <Quantity Q>
  void out(const char*, const Out<Q>&) {}
};

}  // namespace tactus::fuzz
