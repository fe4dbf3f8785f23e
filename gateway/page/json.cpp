#include "gateway/page/json.hpp"

#include <charconv>
#include <cmath>
#include <cstring>

namespace tactus {

void Json::put(std::string_view text) {
  full_ = full_ || text.size() > capacity_ - size_;
  if (full_) return;
  std::memcpy(to_ + size_, text.data(), text.size());
  size_ += text.size();
}

void Json::quoted(std::string_view text) {
  put("\"");
  for (const char c : text) {
    const bool printable = c >= ' ' && c <= '~';
    if (c == '"' || c == '\\') put("\\");
    put(printable ? std::string_view(&c, 1) : "?");
  }
  put("\"");
}

/// Writes the comma and the key before a value.
void Json::begin(const char* key) {
  const char last = size_ > 0 ? to_[size_ - 1] : '{';
  if (last != '{' && last != '[') put(",");
  if (key == nullptr) return;
  quoted(key);
  put(":");
}

Json& Json::open(char bracket, const char* key) {
  begin(key);
  put({&bracket, 1});
  return *this;
}

Json& Json::close(char bracket) {
  put({&bracket, 1});
  return *this;
}

Json& Json::number(double value, const char* key) {
  begin(key);
  char digits[32];
  const auto end =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 9);
  put(std::isfinite(value) ? std::string_view(digits, static_cast<std::size_t>(end.ptr - digits))
                           : "null");
  return *this;
}

Json& Json::numbers(const char* key, const double* values, std::size_t count) {
  open('[', key);
  for (std::size_t i = 0; i < count; ++i) number(values[i]);
  return close(']');
}

Json& Json::integer(std::int64_t value, const char* key) {
  begin(key);
  char digits[24];
  const auto end = std::to_chars(digits, digits + sizeof digits, value);
  put({digits, static_cast<std::size_t>(end.ptr - digits)});
  return *this;
}

Json& Json::flag(bool value, const char* key) {
  begin(key);
  put(value ? "true" : "false");
  return *this;
}

Json& Json::string(std::string_view text, const char* key) {
  begin(key);
  quoted(text);
  return *this;
}

}  // namespace tactus
