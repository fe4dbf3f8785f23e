// RtdeStream: assembles whole RTDE packets from the pieces that a connection delivers.
#pragma once

#include "hal/net/socket.hpp"
#include "hal/ur/protocol.hpp"

namespace tactus::ur {

/// A whole packet without its header, valid until the next call of next().
struct RtdePacket {
  RtdeType type = RtdeType::kTextMessage;
  const std::uint8_t* payload = nullptr;
  std::size_t size = 0;
};

class RtdeStream {
 public:
  Socket socket;

  /// [init]
  Status connect(const char* address, int port, const Deadline& deadline, Message& why) {
    frames_.clear();
    return socket.connect(address, port, deadline, why);
  }

  /// Returns the next packet; `any` is false if none is complete. kConnectionLost; kWireFormat: the
  /// length is impossible. Reads at most one buffer. [cyclic]
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
  static constexpr std::size_t kLongest = 4096;  ///< bytes of a packet; ours have about 500

  Frames<2, kRtdeHeader, kLongest> frames_;
};

}  // namespace tactus::ur
