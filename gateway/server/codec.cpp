#include "gateway/server/codec.hpp"

#include <pb_decode.h>
#include <pb_encode.h>

namespace tactus {

bool decode(const Bytes& bytes, tactus_ToServer& message, const char*& why) {
  pb_istream_t stream = pb_istream_from_buffer(bytes.data, bytes.size);
  const bool good = pb_decode(&stream, tactus_ToServer_fields, &message);
  why = good ? "" : PB_GET_ERROR(&stream);
  return good;
}

std::size_t encode(const tactus_ToClient& message,
                   std::array<std::uint8_t, kLongestToClient>& bytes) {
  pb_ostream_t stream = pb_ostream_from_buffer(bytes.data(), bytes.size());
  return pb_encode(&stream, tactus_ToClient_fields, &message) ? stream.bytes_written : 0;
}

bool decode(const Bytes& bytes, tactus_ToClient& message) {
  pb_istream_t stream = pb_istream_from_buffer(bytes.data, bytes.size);
  return pb_decode(&stream, tactus_ToClient_fields, &message);
}

std::size_t encode(const tactus_ToServer& message, const ByteSpace& to) {
  pb_ostream_t stream = pb_ostream_from_buffer(to.data, to.size);
  return pb_encode(&stream, tactus_ToServer_fields, &message) ? stream.bytes_written : 0;
}

}  // namespace tactus
