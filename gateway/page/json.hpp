// Json: writes JSON (RFC 8259) into memory of fixed size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus {

class Json {
 public:
  Json(char* to, std::size_t size) : to_(to), capacity_(size) {}

  /// Opens an object or array, '{' or '['; in an object it has a key. [any]
  Json& open(char bracket, const char* key = nullptr);
  Json& close(char bracket);
  /// Writes a number with nine significant digits, null for one that is not finite. [any]
  Json& number(double value, const char* key = nullptr);
  Json& numbers(const char* key, const double* values, std::size_t count);
  Json& integer(std::int64_t value, const char* key = nullptr);
  Json& flag(bool value, const char* key);
  /// Writes a string; bytes that are not printable ASCII become '?'. [any]
  Json& string(std::string_view text, const char* key = nullptr);

  /// Everything up to now, if it had space; else nothing. [any]
  std::string_view text() const {
    return full_ ? std::string_view() : std::string_view(to_, size_);
  }

 private:
  void begin(const char* key);
  void put(std::string_view text);
  void quoted(std::string_view text);

  char* to_;
  std::size_t capacity_, size_ = 0;
  bool full_ = false;
};

}  // namespace tactus
