// DriveBus: the drives of one bus and the frames that they send.
#pragma once

#include "kernel/core/types.hpp"
#include "sim_plant/drives/node.hpp"

namespace tactus::drives {

class DriveBus {
 public:
  static constexpr std::size_t kMost = kDof;  ///< drives on one bus

  void clear() {
    count_ = 0;
    queue_.clear();
  }
  void add(Node& node) { nodes_[count_++] = &node; }
  FrameQueue& queue() { return queue_; }

  Node* const* begin() const { return nodes_.data(); }
  Node* const* end() const { return nodes_.data() + count_; }

  /// True if a drive takes this identifier for SYNC. [any]
  bool is_sync(const can::CanFrame& frame) const {
    for (const Node* node : *this)
      if (!frame.remote && node->sync_id() == frame.id) return true;
    return false;
  }

 private:
  std::array<Node*, kMost> nodes_{};
  std::size_t count_ = 0;
  FrameQueue queue_;
};

}  // namespace tactus::drives
