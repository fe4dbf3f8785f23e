// The messages of gateway/tactus.proto as structs of fixed size, by nanopb.
#pragma once

#include <string_view>

#include "gateway/server/byte_queues.hpp"
#include "gateway/tactus.pb.h"

namespace tactus {

/// Reads a message. False: `why` has nanopb's text. [any]
bool decode(const Bytes& bytes, tactus_ToServer& message, const char*& why);

/// Writes a message into `bytes`; returns its size, 0 if it does not fit. [any]
std::size_t encode(const tactus_ToClient& message,
                   std::array<std::uint8_t, kLongestToClient>& bytes);

/// The same at the other end, for a client. [any]
bool decode(const Bytes& bytes, tactus_ToClient& message);
std::size_t encode(const tactus_ToServer& message, const ByteSpace& to);

/// Copies a text into a field, cut to its size. [any]
template <std::size_t N>
void set_text(char (&field)[N], std::string_view text) {
  const std::size_t size = text.size() < N ? text.size() : N - 1;
  if (size > 0) std::memcpy(field, text.data(), size);
  field[size] = '\0';
}

/// Copies numbers into a repeated field. [any]
template <std::size_t N>
void set_numbers(double (&field)[N], pb_size_t& count, const double* numbers, int size) {
  static_assert(N <= 65535);
  count = static_cast<pb_size_t>(size);
  std::memcpy(field, numbers, sizeof(double) * static_cast<std::size_t>(size));
}

}  // namespace tactus
