// Text: a string of fixed capacity for names and error messages. It cuts off text that does not
// fit.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "kernel/core/describe.hpp"

namespace tactus {

/// Appends to the first `size` characters of `buffer`; returns the new size, at most `capacity`.
/// [any]
std::size_t append_text(char* buffer, std::size_t size, std::size_t capacity,
                        std::string_view text);
/// Do the same for an integer, and for a double with at most so many significant digits, 1 to 9:
/// "0.785398", "1.5e-6".
std::size_t append_int(char* buffer, std::size_t size, std::size_t capacity, long long value);
std::size_t append_double(char* buffer, std::size_t size, std::size_t capacity, double value,
                          int significant);

template <std::size_t N>
class Text {
 public:
  Text() = default;
  Text(std::string_view text) {
    *this << text;
  }  // NOLINT(google-explicit-constructor): a string is a Text

  Text& operator<<(std::string_view text) {
    size_ = append_text(buffer_.data(), size_, N, text);
    return *this;
  }
  Text& operator<<(const char* text) { return *this << std::string_view(text); }
  Text& operator<<(int value) {
    size_ = append_int(buffer_.data(), size_, N, value);
    return *this;
  }
  Text& operator<<(std::size_t value) {
    size_ = append_int(buffer_.data(), size_, N, static_cast<long long>(value));
    return *this;
  }
  Text& operator<<(double value) { return append(value, 6); }
  Text& append(double value, int significant) {
    size_ = append_double(buffer_.data(), size_, N, value, significant);
    return *this;
  }
  /// Appends the range as a requirement: "> 0", ">= 0", "> 0 and at most 1", "in [0, 16]".
  Text& operator<<(const Range& range) {
    const bool positive = range.lo == kPositive.lo;
    if (range.hi == kInfinity && range.lo == -kInfinity) return *this << "finite";
    if (range.hi == kInfinity) return positive ? *this << "> 0" : *this << ">= " << range.lo;
    if (positive) return *this << "> 0 and at most " << range.hi;
    return *this << "in [" << range.lo << ", " << range.hi << "]";
  }

  operator std::string_view() const { return {buffer_.data(), size_}; }  // NOLINT
  const char* c_str() const { return buffer_.data(); }
  bool empty() const { return size_ == 0; }
  static constexpr std::size_t capacity() { return N; }

 private:
  std::array<char, N + 1> buffer_{};  // always ends in a zero
  std::size_t size_ = 0;
};

/// An explanation for an operator.
using Message = Text<383>;

}  // namespace tactus
