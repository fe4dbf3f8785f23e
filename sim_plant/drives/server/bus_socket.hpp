// BusSocket: the frames of one bus, from a raw SocketCAN socket or from a socket that carries
// struct can_frame and struct canfd_frame as packets.
#pragma once

#include "hal/can/protocol_frame.hpp"

namespace tactus::drives {

class BusSocket {
 public:
  BusSocket() = default;
  BusSocket(const BusSocket&) = delete;
  BusSocket& operator=(const BusSocket&) = delete;
  ~BusSocket();

  /// Opens a CAN interface. False: `what()` and errno say why. [init]
  bool open(const char* interface, bool fd);
  /// Takes over an open descriptor. False: it is none. [init]
  bool adopt(int descriptor);

  /// Receives a frame without waiting; false: there is none now. Frames with 29-bit identifiers and
  /// error frames are left out. [cyclic]
  bool receive(can::CanFrame& frame);
  /// Sends without waiting. False: try again later. A frame that the bus cannot carry is lost.
  /// [cyclic]
  bool send(const can::CanFrame& frame);

  int descriptor() const { return socket_; }  ///< -1: closed, because the other end is
  const char* what() const { return what_; }

 private:
  int socket_ = -1;
  const char* what_ = "";
};

}  // namespace tactus::drives
