// RtdeStream: whole packets of RTDE out of whatever pieces a connection delivers.
#pragma once

#include "hal/ur/protocol.hpp"
#include "hal/ur/socket.hpp"

namespace tactus::ur {

/// A whole packet without its header, valid until the next one is asked for.
struct RtdePacket {
  RtdeType type = RtdeType::kTextMessage;
  const std::uint8_t* payload = nullptr;
  std::size_t size = 0;
};

class RtdeStream {
 public:
  Socket socket;

  /// [init]
  Status connect(const char* address, int port, int timeout_ms, Message& why) {
    frames_.clear();
    return socket.connect(address, port, timeout_ms, why);
  }

  /// The next packet, if `any` is complete. kConnectionLost; kWireFormat: no packet has such a
  /// length. Bounded by the size of the buffer. [cyclic]
  Status next(RtdePacket& packet, bool& any, Message& why);

  /// Sends a packet that `begin` began. [cyclic]
  Socket::Sent send(ByteWriter& packet) {
    packet.set_u16(0, packet.size());
    return packet.ok() ? socket.send(packet.data(), packet.size()) : Socket::Sent::kLost;
  }
  static void begin(ByteWriter& packet, RtdeType type) {
    packet.u16(0);
    packet.u8(static_cast<std::uint8_t>(type));
  }

 private:
  static constexpr std::size_t kLongest = 4096;  ///< of a controller's packets: ours have 400 bytes

  Frames<2, kRtdeHeader, kLongest> frames_;
};

}  // namespace tactus::ur
