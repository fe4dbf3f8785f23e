#include "hal/ur/rtde_stream.hpp"

namespace tactus::ur {

NextPacket RtdeStream::next(RtdePacket& packet, Message& why) {
  Packet found;
  NextPacket next = frames_.next(found);
  if (next == NextPacket::kNone) {
    std::array<std::uint8_t, kLongest> bytes;
    const std::size_t room = frames_.room();
    const long got = socket.receive(bytes.data(), room);
    if (got < 0) return why = Message("the connection was closed"), NextPacket::kBroken;
    frames_.take(bytes.data(), static_cast<std::size_t>(got));
    next = frames_.next(found);
  }
  if (next == NextPacket::kBroken) {
    why = Message("RTDE: a packet with a length outside 3 to ");
    why << kLongest;
  }
  if (next == NextPacket::kPacket)
    packet = {static_cast<RtdeType>(found.data[2]), found.data + kRtdeHeader,
              found.size - kRtdeHeader};
  return next;
}

}  // namespace tactus::ur
