#include "hal/ur/rtde_stream.hpp"

namespace tactus::ur {

Status RtdeStream::next(RtdePacket& packet, bool& any, Message& why) {
  Packet found;
  NextPacket next = frames_.next(found);
  if (next == NextPacket::kNone) {
    std::array<std::uint8_t, kLongest> bytes;
    const long got = socket.receive(bytes.data(), frames_.room());
    if (got < 0) {
      why = Message("the connection was closed");
      return Status::kConnectionLost;
    }
    frames_.take(bytes.data(), static_cast<std::size_t>(got));
    next = frames_.next(found);
  }
  any = next == NextPacket::kPacket;
  if (any)
    packet = {static_cast<RtdeType>(found.data[2]), found.data + kRtdeHeader,
              found.size - kRtdeHeader};
  if (next != NextPacket::kBroken) return Status::kOk;
  why = Message("the length of a packet is outside 3 to ");
  why << kLongest << " bytes";
  return Status::kWireFormat;
}

}  // namespace tactus::ur
