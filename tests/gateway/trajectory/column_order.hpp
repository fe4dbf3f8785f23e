// The columns of a trajectory file in any order.
#pragma once

#include <array>
#include <numeric>
#include <random>
#include <utility>

namespace tactus {

/// The numbers 0 to Count - 1, shuffled by Fisher and Yates.
template <int Count>
std::array<int, Count> any_order(std::mt19937_64& random) {
  std::array<int, Count> order;
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = Count - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
  return order;
}

}  // namespace tactus
