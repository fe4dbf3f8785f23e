// Names of enumerators, as files, logs and tables print them. An enumeration has them in one
// function after its definition,
//
//   constexpr const char* name(E value)
//
// a switch over all enumerators that ends with `return nullptr`. The compiler refuses a switch that
// leaves an enumerator out.
#pragma once

#include <array>
#include <cstddef>

namespace tactus {

namespace detail {
template <class E>
constexpr std::size_t count_names() {
  std::size_t count = 0;
  while (name(static_cast<E>(count)) != nullptr) ++count;
  return count;
}

template <class E>
constexpr auto names_of() {
  std::array<const char*, count_names<E>()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = name(static_cast<E>(i));
  return names;
}
}  // namespace detail

/// The names of an enumeration whose enumerators count from 0 without a gap.
template <class E>
inline constexpr auto kNames = detail::names_of<E>();

}  // namespace tactus
