// PacketSocket: EtherCAT frames of one network interface through AF_PACKET, past its queueing
// discipline. It receives no copies of what it sends.
#pragma once

#include "hal/ethercat/protocol_frame.hpp"
#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"

namespace tactus::ethercat {

class PacketSocket {
 public:
  PacketSocket() = default;
  ~PacketSocket() { close(); }
  PacketSocket(const PacketSocket&) = delete;
  PacketSocket& operator=(const PacketSocket&) = delete;

  /// Opens an interface that is up, and keeps other programs that do so off it. kBusConflict: one
  /// has it; kNotOffered: this program or kernel may not; kBadValue: there is no such interface, or
  /// it is none of Ethernet; kConnectionLost: it is down. [init]
  Status open(const char* interface, Message& why);
  /// Takes over an open socket that carries a frame in each packet. False: it is none. [init]
  bool adopt(int descriptor);
  void close();  ///< [any]

  /// Takes the next frame that has arrived; false: there is none. Never blocks. [cyclic]
  bool receive(Frame& frame);
  /// Sends a frame; false: it could not be sent. Never blocks. [cyclic]
  bool send(const Frame& frame);
  /// Waits for a frame, at most `longest_ns`. False: a signal arrived. [init]
  bool wait(std::int64_t longest_ns);

  bool is_open() const { return socket_ >= 0; }
  /// True after the interface went down or away. [any]
  bool lost() const { return lost_; }
  /// Ethernet address of the interface. [any]
  const std::uint8_t* address() const { return address_.data(); }
  int descriptor() const { return socket_; }
  /// System calls since it was opened. [any]
  int system_calls() const { return system_calls_; }

 private:
  Status refuse(Status status, const char* what, const char* remedy, Message& why);
  Status claim(const char* interface, Message& why);
  Status bind_to(const char* interface, Message& why);

  int socket_ = -1;
  int claim_ = -1;  // a socket whose name marks the interface as in use
  bool lost_ = false;
  int system_calls_ = 0;
  std::array<std::uint8_t, 6> address_{{0x02, 0, 0, 0, 0, 0x01}};
};

}  // namespace tactus::ethercat
