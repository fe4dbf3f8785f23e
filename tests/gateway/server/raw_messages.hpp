// Protobuf's bytes, written and read by hand: the client's end of the tests shares no code with the
// server's.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tactus {

struct RawMessage {
  std::array<std::uint8_t, 20000> bytes;
  std::size_t size = 0;

  void byte(std::uint8_t value) { bytes[size++] = value; }
  void varint(std::uint64_t value) {
    for (; value >= 128; value >>= 7) byte(static_cast<std::uint8_t>(value | 128));
    byte(static_cast<std::uint8_t>(value));
  }
  RawMessage& number(std::uint32_t field, std::uint64_t value) {
    varint(field << 3);
    varint(value);
    return *this;
  }
  RawMessage& time(std::uint32_t field, std::int64_t value) {  // sint64
    return number(field,
                  static_cast<std::uint64_t>(value) << 1 ^ static_cast<std::uint64_t>(value >> 63));
  }
  void raw(const void* data, std::size_t count) {
    std::memcpy(bytes.data() + size, data, count);
    size += count;
  }
  RawMessage& fixed64(std::uint32_t field, std::uint64_t value) {
    varint(field << 3 | 1);
    raw(&value, 8);
    return *this;
  }
  RawMessage& real(std::uint32_t field, double value) {
    varint(field << 3 | 1);
    raw(&value, 8);
    return *this;
  }
  RawMessage& block(std::uint32_t field, const void* data, std::size_t count) {
    varint(field << 3 | 2);
    varint(count);
    raw(data, count);
    return *this;
  }
  RawMessage& text(std::uint32_t field, std::string_view text) {
    return block(field, text.data(), text.size());
  }
  RawMessage& reals(std::uint32_t field, const double* numbers, std::size_t count) {
    return block(field, numbers, 8 * count);
  }
  RawMessage& message(std::uint32_t field, const RawMessage& inner) {
    return block(field, inner.bytes.data(), inner.size);
  }
};

/// One field after the other of a message.
struct RawFields {
  const std::uint8_t* at;
  const std::uint8_t* end;
  std::uint32_t field = 0;
  std::uint64_t value = 0;  // a varint, or the bits of a number
  RawFields inner() const { return {block, block + block_size}; }
  const std::uint8_t* block = nullptr;
  std::size_t block_size = 0;

  RawFields(const std::uint8_t* from, const std::uint8_t* to) : at(from), end(to) {}
  std::uint64_t varint() {
    std::uint64_t number = 0;
    for (int shift = 0; at < end; shift += 7) {
      const std::uint8_t byte = *at++;
      number |= static_cast<std::uint64_t>(byte & 127) << shift;
      if (byte < 128) break;
    }
    return number;
  }
  bool next() {
    if (at >= end) return false;
    const std::uint64_t tag = varint();
    field = static_cast<std::uint32_t>(tag >> 3);
    if ((tag & 7) == 0) {
      value = varint();
    } else if ((tag & 7) == 1) {
      std::memcpy(&value, at, 8);
      at += 8;
    } else {
      block_size = varint();
      block = at;
      at += block_size;
    }
    return at <= end;
  }
  std::string_view text() const { return {reinterpret_cast<const char*>(block), block_size}; }
};

}  // namespace tactus
