#include "sim_plant/ur/wire/links.hpp"

#include <algorithm>
#include <cstring>

namespace tactus::ur {

void Link::want(std::string_view name, std::string_view host, int port) {
  name_ = name;
  host_ = host;
  port_ = port;
  in_size_ = 0;
  out_.clear();
  lost_ = false;
  state_ = State::kWanted;
}

bool Link::read_ints(std::int32_t* values, std::size_t count) {
  const std::size_t size = 4 * count;
  if (in_size_ < size) return false;
  ByteReader reader(in_.data(), size);
  for (std::size_t i = 0; i < count; ++i) values[i] = reader.i32();
  std::memmove(in_.data(), in_.data() + size, in_size_ - size);
  in_size_ -= size;
  return true;
}

void Link::send_int(std::int32_t value) {
  std::array<std::uint8_t, 4> bytes;
  ByteWriter writer(bytes.data(), bytes.size());
  writer.i32(value);
  out_.put(bytes.data(), bytes.size());
}

void Link::receive(const std::uint8_t* data, std::size_t size) {
  size = std::min(size, room());
  if (size > 0) std::memcpy(in_.data() + in_size_, data, size);
  in_size_ += size;
}

Link* Links::find(std::string_view name) {
  for (Link& link : links_)
    if (link.state() != Link::State::kClosed && link.name() == name) return &link;
  for (Link& link : links_)
    if (link.state() == Link::State::kClosed) return &link;
  return nullptr;
}

}  // namespace tactus::ur
