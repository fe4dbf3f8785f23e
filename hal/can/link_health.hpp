// LinkHealth: the state of one CAN bus as its controller and its socket report it.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus::can {

inline constexpr std::size_t kErrorData = 8;  ///< bytes of an error frame

/// The counts begin when the link is opened.
struct LinkHealth {
  bool lost = false;  ///< the interface or the peer has gone; stays until the link is opened again
  bool bus_off = false;
  bool error_passive = false;  ///< an error counter of the controller is at least 128
  bool warning = false;        ///< at least 96
  std::uint8_t tx_errors = 0, rx_errors = 0;  ///< the controller's counters, if reported
  std::uint32_t error_frames = 0;             ///< reports of the controller
  std::uint32_t restarted = 0;   ///< returns from bus-off; a bus-off between two reads shows here
  std::uint32_t bus_errors = 0;  ///< bit, form, stuff or CRC errors
  std::uint32_t unacknowledged = 0;  ///< no other node heard a frame of ours
  std::uint32_t overflows = 0;       ///< the controller had no room for a frame
  std::uint32_t dropped = 0;         ///< the socket had no room for a frame
  std::uint32_t malformed = 0;       ///< packets that are no frame
  std::uint32_t foreign = 0;         ///< frames with 29-bit identifiers
  std::uint32_t unsent = 0;          ///< frames of ours that the socket did not take

  /// Takes an error frame: its classes, which are the bits of its identifier, and its data.
  /// [cyclic]
  void take_error(std::uint32_t classes, const std::uint8_t (&data)[kErrorData]);
};

}  // namespace tactus::can
