// A mutator for targets that read text. Every second mutation replaces a number of the text by a
// value at which arithmetic or a limit changes its behaviour; byte mutations hardly ever produce
// such a word. Each target includes it once.
#pragma once

#include <cstring>
#include <random>

#include "tests/fuzz/fuzzing.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace tactus::fuzz {

inline bool is_number_character(std::uint8_t c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

/// Finds the first number of the text from `at` on, wrapping: sets `at` to its place and returns
/// its length; 0 if there is none.
inline std::size_t find_number(const std::uint8_t* data, std::size_t size, std::size_t& at) {
  for (std::size_t tried = 0; tried < size && !is_number_character(data[at]); ++tried)
    at = (at + 1) % size;
  std::size_t end = at;
  while (end < size && is_number_character(data[end])) ++end;
  return end - at;
}

inline std::string_view other_number(std::minstd_rand& random) {
  constexpr std::string_view kNumbers[] = {
      "0",     "1",      "-1",      "0.001", "10",   "-0",  "1e3", "1e-300", "1e300",
      "-1e30", "5e-324", "1.7e308", "65536", "1e10", "nan", "inf", "-inf",   "2147483648"};
  return kNumbers[random() % std::size(kNumbers)];
}

}  // namespace tactus::fuzz

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  using namespace tactus::fuzz;
  std::minstd_rand random(seed);
  if (size == 0 || random() % 2 == 0) return LLVMFuzzerMutate(data, size, most);
  std::size_t at = random() % size;
  const std::size_t length = find_number(data, size, at);
  const std::string_view number = other_number(random);
  if (length == 0 || size - length + number.size() > most)
    return LLVMFuzzerMutate(data, size, most);
  std::memmove(data + at + number.size(), data + at + length, size - at - length);
  std::memcpy(data + at, number.data(), number.size());
  return size - length + number.size();
}
