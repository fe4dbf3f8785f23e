#include "tests/fuzz/ur/wire.hpp"

#include <cstring>

#include "hal/net/socket.hpp"

namespace tactus::fuzz {
Wire wire;
}

namespace tactus::ur {

using fuzz::wire;

bool is_ipv4(const char*) {
  return true;
}
Status Socket::connect(const char*, int, const Deadline&, Message&) {
  socket_ = 1;
  return Status::kOk;
}
bool Socket::begin(const char*, int) {
  return false;
}
bool Socket::send_some(std::string_view& text) {
  text = {};
  return connected();
}
bool Socket::wait(std::int64_t) const {
  return wire.at < wire.tape->size || !wire.tape->hangs;
}
long Socket::receive(std::uint8_t* data, std::size_t size) {
  MUST(connected());
  const std::size_t left = wire.tape->size - wire.at;
  if (left == 0) return wire.tape->hangs ? 0 : -1;
  const std::size_t got = std::min({size, left, wire.tape->piece});
  if (got > 0) std::memcpy(data, wire.tape->data + wire.at, got);
  wire.at += got;
  return static_cast<long>(got);
}
Socket::Sent Socket::send(const std::uint8_t*, std::size_t) {
  return connected() ? Sent::kAll : Sent::kLost;
}
void Socket::close() {
  socket_ = -1;
}

}  // namespace tactus::ur
