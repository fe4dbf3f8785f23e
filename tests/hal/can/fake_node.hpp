// A node that answers SDO reads out of a list, for tests of a scan.
#pragma once

#include <algorithm>
#include <cstring>
#include <string_view>
#include <vector>

#include "hal/can/protocol_frame.hpp"

namespace tactus::can {

struct FakeObject {
  std::uint16_t index;
  std::uint8_t sub;
  std::uint32_t value;
  std::string_view text = {};  ///< if not empty, the object is this text
};

struct FakeNode {
  int node = 1;
  std::vector<FakeObject> objects;
  int answers_left = 1000000;  ///< after which the node is silent
  int asked = 0;               ///< requests that came

  /// Returns whether the node answers, and how.
  bool answer(const CanFrame& request, CanFrame& reply) {
    if (request.id != 0x600 + node || request.size != 8) return false;
    ++asked;
    if (answers_left == 0) return false;
    --answers_left;
    reply = CanFrame();
    reply.id = static_cast<std::uint16_t>(0x580 + node);
    reply.size = 8;
    if ((request.data[0] & 0xE0) == 0x60) return next_segment(reply);
    for (std::size_t i = 1; i < 4; ++i) reply.data[i] = request.data[i];
    const int index = request.data[1] | request.data[2] << 8;
    for (const FakeObject& object : objects)
      if (object.index == index && object.sub == request.data[3]) return upload(object, reply);
    put(reply, 0x80, 0x06020000);
    return true;
  }

 private:
  static void put(CanFrame& reply, std::uint8_t command, std::uint32_t value) {
    reply.data[0] = command;
    for (std::size_t i = 0; i < 4; ++i)
      reply.data[4 + i] = static_cast<std::uint8_t>(value >> 8 * i);
  }
  bool upload(const FakeObject& object, CanFrame& reply) {
    rest_ = object.text;
    toggle_ = 0;
    if (rest_.empty())
      put(reply, 0x43, object.value);
    else
      put(reply, 0x41, static_cast<std::uint32_t>(rest_.size()));
    return true;
  }
  bool next_segment(CanFrame& reply) {
    const std::size_t bytes = std::min<std::size_t>(rest_.size(), 7);
    const bool last = bytes == rest_.size();
    reply.data[0] = static_cast<std::uint8_t>(toggle_ | (7 - bytes) << 1 | (last ? 1 : 0));
    std::memcpy(&reply.data[1], rest_.data(), bytes);
    rest_.remove_prefix(bytes);
    toggle_ ^= 0x10;
    return true;
  }

  std::string_view rest_;
  unsigned toggle_ = 0;
};

}  // namespace tactus::can
