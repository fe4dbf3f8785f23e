// HeartbeatWatch: whether a node is alive, by its heartbeat (CiA 301, 7.2.8.3.2). The time is
// passed in.
#pragma once

#include <cstdint>

#include "hal/can/protocol_canopen.hpp"

namespace tactus::can {

class HeartbeatWatch {
 public:
  /// Watches a node from now on: without a heartbeat for `timeout_ns` it is lost. [any]
  void start(std::uint8_t node, std::int64_t timeout_ns, std::int64_t now_ns) {
    *this = HeartbeatWatch();
    node_ = node;
    timeout_ns_ = timeout_ns;
    heard_ns_ = now_ns;
  }

  /// Takes any frame of the bus; true: it was a heartbeat or the boot-up message of this node.
  /// Bytes that are no state of the standard are counted as malformed and prove nothing. [any]
  bool receive(const CanFrame& frame, std::int64_t now_ns) {
    if (node_ == 0 || frame.id != kHeartbeatBase + node_ || frame.remote) return false;
    const auto state = static_cast<NmtState>(frame.data[0]);
    if (frame.size != 1 || name(state) == nullptr) {
      ++malformed_;
      return false;
    }
    heard_ns_ = now_ns;
    known_ = true;
    state_ = state;
    if (state == NmtState::kBootUp) ++boot_ups_;
    return true;
  }

  /// Returns true if the last heartbeat, or the start, is `timeout_ns` ago. [any]
  bool is_lost(std::int64_t now_ns) const {
    return node_ != 0 && now_ns - heard_ns_ >= timeout_ns_;
  }
  /// Whether a heartbeat has arrived since the start; the state is that of the last one. [any]
  bool known() const { return known_; }
  NmtState state() const { return state_; }
  /// Boot-up messages since the start: one more than a reset explains is a node that restarted by
  /// itself and lost its configuration. [any]
  int boot_ups() const { return boot_ups_; }
  int malformed() const { return malformed_; }
  /// When the last heartbeat came. [any]
  std::int64_t heard_ns() const { return heard_ns_; }

 private:
  std::uint8_t node_ = 0;
  bool known_ = false;
  NmtState state_ = NmtState::kBootUp;
  int boot_ups_ = 0, malformed_ = 0;
  std::int64_t timeout_ns_ = 0, heard_ns_ = 0;
};

}  // namespace tactus::can
