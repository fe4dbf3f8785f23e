// CanSocket: one CAN bus, through a raw socket of the kernel or through a packet socket that a
// launcher or a test hands over. The cycle takes the frames that have arrived with one system call
// and sends with another; neither waits.
#pragma once

#include <sys/socket.h>
#include <sys/uio.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/can/can_filter.hpp"
#include "hal/can/link_health.hpp"
#include "hal/can/protocol_frame.hpp"
#include "kernel/core/load_error.hpp"

namespace tactus::can {

/// kQueueFull: at least one frame was not sent.
enum class Sent : std::uint8_t { kAll, kQueueFull, kLost };

enum class WaitResult : std::uint8_t { kSomething, kNothing, kInterrupted };

class CanSocket {
 public:
  static constexpr int kBatch = 64;        ///< packets of one system call
  static constexpr int kMostFilters = 64;  ///< of one socket

  CanSocket() = default;
  CanSocket(const CanSocket&) = delete;
  CanSocket& operator=(const CanSocket&) = delete;
  ~CanSocket() { close(); }

  /// Opens an interface such as "can0", or adopts the packet socket that this process inherited as
  /// descriptor 3 if it is called "fd:3". `fd`: CAN FD frames too. No filters: all frames are
  /// received. kNotOffered: the kernel has no CAN; kTooLarge: more than kMostFilters filters;
  /// kConnectionLost: `why` names interface and reason. [init]
  Status open(const char* interface, bool fd, const CanFilter* filters, int count, Message& why);
  /// Takes over an open packet socket that carries struct can_frame and, if `fd`, struct
  /// canfd_frame; it is closed with this object. [init]
  void adopt(int descriptor, bool fd, const CanFilter* filters = nullptr, int count = 0);
  /// Waits until a frame, or the end of the link, can be received. kInterrupted: a signal arrived.
  /// [init]
  WaitResult wait(std::int64_t timeout_ns) const;
  /// [any]
  void close();
  bool is_open() const { return socket_ >= 0; }

  /// Copies the data frames that have arrived, at most `capacity` and at most kBatch, and returns
  /// their number. Error frames, malformed packets and frames with 29-bit identifiers are only
  /// counted in health(). [cyclic]
  int receive(CanFrame* frames, int capacity);

  /// Sends frames in this order, at most kBatch; what the socket does not take is counted as unsent
  /// and is not sent later. The data of a CAN FD frame is padded with zeros to a length that
  /// exists. [cyclic]
  Sent send(const CanFrame* frames, int count);

  const LinkHealth& health() const { return health_; }
  /// System calls of receive() and send() since the link was opened. [any]
  int system_calls() const { return system_calls_; }
  /// Frames that the interface queues for sending; -1: unknown. [any]
  int queue_frames() const { return queue_frames_; }

 private:
  static constexpr std::size_t kPacket = 72;   ///< bytes of a struct canfd_frame
  static constexpr std::size_t kControl = 64;  ///< bytes of a time stamp and a count of drops
  static constexpr std::size_t kIdentifiers = 2048;

  struct Batch {
    std::array<mmsghdr, kBatch> headers;
    std::array<iovec, kBatch> pieces;
    alignas(8) std::array<std::array<std::uint8_t, kPacket>, kBatch> packets;
    alignas(8) std::array<std::array<std::uint8_t, kControl>, kBatch> controls;
  };

  void begin(int descriptor, bool fd, const CanFilter* filters, int count);
  Status inherit(const char* interface, bool fd, const CanFilter* filters, int count, Message& why);
  Status bind_to(const char* interface, bool fd, Message& why);
  void want(const CanFilter* filters, int count);
  bool wanted(std::uint32_t id) const { return (wanted_[id / 32] >> id % 32 & 1U) != 0; }
  bool take_packet(const mmsghdr& header, CanFrame& frame);
  void take_control(const mmsghdr& header, CanFrame& frame);
  bool hung_up() const;
  std::size_t write_packet(const CanFrame& frame, std::array<std::uint8_t, kPacket>& packet) const;

  int socket_ = -1;
  bool fd_ = false;
  int system_calls_ = 0;
  int queue_frames_ = -1;
  LinkHealth health_;
  std::array<std::uint32_t, kIdentifiers / 32> wanted_{};  ///< a bit for every identifier
  Batch batch_{};
};

}  // namespace tactus::can
