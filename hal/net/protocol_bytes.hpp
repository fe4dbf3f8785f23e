// Reads and writes the bytes of a protocol: big-endian, unpadded, unaligned, IEEE-754.
// Reader and writer never leave their bounds: the first step that would do so sets a flag; after it
// reads give zero and writes do nothing. A parser checks ok() once, at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tactus {

class ByteReader {
 public:
  ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  std::int8_t i8() { return static_cast<std::int8_t>(u8()); }
  std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
  float f32() { return from_bits<float>(u32()); }
  double f64() { return from_bits<double>(u64()); }

  /// Returns the next `size` characters; empty if fewer are left.
  std::string_view text(std::size_t size) {
    if (size > size_ - at_) ok_ = false;
    if (!ok_) return {};
    const std::string_view view(reinterpret_cast<const char*>(data_) + at_, size);
    at_ += size;
    return view;
  }
  std::string_view rest() { return text(left()); }

  std::size_t left() const { return ok_ ? size_ - at_ : 0; }
  bool ok() const { return ok_; }  ///< nothing was read beyond the end
  /// True if all bytes were read, and none beyond the end.
  bool done() const { return ok_ && at_ == size_; }

 private:
  template <class Float, class Bits>
  static Float from_bits(Bits bits) {
    static_assert(sizeof(Float) == sizeof(Bits));
    Float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::uint64_t number(std::size_t size) {
    if (size > size_ - at_) ok_ = false;
    std::uint64_t value = 0;
    if (!ok_) return value;
    for (std::size_t i = 0; i < size; ++i) value = value << 8 | data_[at_ + i];
    at_ += size;
    return value;
  }

  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
  bool ok_ = true;
};

class ByteWriter {
 public:
  ByteWriter(std::uint8_t* data, std::size_t capacity) : data_(data), capacity_(capacity) {}

  void u8(std::uint8_t value) { number(value, 1); }
  void u16(std::uint16_t value) { number(value, 2); }
  void u32(std::uint32_t value) { number(value, 4); }
  void u64(std::uint64_t value) { number(value, 8); }
  void i8(std::int8_t value) { u8(static_cast<std::uint8_t>(value)); }
  void i32(std::int32_t value) { u32(static_cast<std::uint32_t>(value)); }
  void f32(float value) { u32(to_bits<std::uint32_t>(value)); }
  void f64(double value) { u64(to_bits<std::uint64_t>(value)); }
  void text(std::string_view text) {
    if (text.size() > capacity_ - size_) ok_ = false;
    if (!ok_) return;
    if (!text.empty()) std::memcpy(data_ + size_, text.data(), text.size());
    size_ += text.size();
  }
  /// Writes the length of a text in one byte, then the text, cut to 255 characters.
  void short_text(std::string_view characters) {
    characters = characters.substr(0, 255);
    u8(static_cast<std::uint8_t>(characters.size()));
    text(characters);
  }
  void zeros(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) u8(0);
  }

  /// Overwrites bytes that were written before, such as lengths.
  void set_u16(std::size_t at, std::size_t value) { overwrite(at, value, 2); }
  void set_u32(std::size_t at, std::size_t value) { overwrite(at, value, 4); }

  const std::uint8_t* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool ok() const { return ok_; }  ///< everything fits

 private:
  template <class Bits, class Float>
  static Bits to_bits(Float value) {
    static_assert(sizeof(Float) == sizeof(Bits));
    Bits bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
  }
  void number(std::uint64_t value, std::size_t size) {
    if (size > capacity_ - size_) ok_ = false;
    if (!ok_) return;
    size_ += size;
    put(size_ - size, value, size);
  }
  void overwrite(std::size_t at, std::uint64_t value, std::size_t size) {
    if (ok_ && at + size <= size_) put(at, value, size);
  }
  void put(std::size_t at, std::uint64_t value, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      data_[at + i] = static_cast<std::uint8_t>(value >> (8 * (size - 1 - i)));
  }

  std::uint8_t* data_;
  std::size_t capacity_;
  std::size_t size_ = 0;
  bool ok_ = true;
};

}  // namespace tactus
