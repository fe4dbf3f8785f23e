#include "hal/can/link_health.hpp"

#include <linux/can/error.h>

namespace tactus::can {
namespace {

constexpr std::uint8_t kPassive = CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE;
constexpr std::uint8_t kWarning = CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING;
constexpr std::uint8_t kOverflow = CAN_ERR_CRTL_RX_OVERFLOW | CAN_ERR_CRTL_TX_OVERFLOW;
constexpr std::uint8_t kState = kPassive | kWarning | CAN_ERR_CRTL_ACTIVE;
// Linux 6.0 and newer; the header may be older.
constexpr std::uint32_t kCounters = 0x00000200;

}  // namespace

void LinkHealth::take_error(std::uint32_t classes, const std::uint8_t (&data)[kErrorData]) {
  ++error_frames;
  // A report may contain an overflow only; the state is then unchanged.
  if ((classes & CAN_ERR_CRTL) != 0 && (data[1] & kState) != 0) {
    error_passive = (data[1] & kPassive) != 0;
    warning = error_passive || (data[1] & kWarning) != 0;
  }
  if ((classes & CAN_ERR_CRTL) != 0 && (data[1] & kOverflow) != 0) ++overflows;
  if ((classes & (CAN_ERR_PROT | CAN_ERR_BUSERROR)) != 0) ++bus_errors;
  if ((classes & CAN_ERR_ACK) != 0) ++unacknowledged;
  if ((classes & CAN_ERR_RESTARTED) != 0) {
    ++restarted;
    bus_off = error_passive = warning = false;
  }
  if ((classes & CAN_ERR_BUSOFF) != 0) bus_off = true;
  if ((classes & kCounters) != 0) {
    tx_errors = data[6];
    rx_errors = data[7];
  }
}

}  // namespace tactus::can
