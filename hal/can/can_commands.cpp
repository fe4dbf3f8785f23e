// CanMaster: the frames that it sends in a cycle.
#include "hal/can/can_master.hpp"
#include "kernel/core/loop_bound.hpp"

namespace tactus::can {

/// On the way up or down the controlwords go out in every cycle: a frame that was lost must not let
/// a drive wait.
void CanMaster::send_commands() {
  const cia402::Phase phase = drives_.phase();
  const bool on_its_way = phase != cia402::Phase::kOff && phase != cia402::Phase::kArmed;
  bool changed = ++since_refresh_ >= PdoLayout::kRefresh || on_its_way;
  for (std::size_t j = 0; j < kDof; ++j)
    changed = changed || commands_[j].controlword != sent_[j].controlword;
  const bool split = layout_.packed() && !layout_.fd();  // the controlwords have their own frame
  LoopBound<2> frames;
  for (int number = 1; number <= layout_.command_frames(); ++number) {
    frames.tick();
    if (split && number == 1 && !changed) continue;
    std::array<CanFrame, kMaxBuses> common;
    for (std::size_t j = 0; j < kDof; ++j) {
      const Node& node = nodes_[j];
      CanFrame single;
      CanFrame& frame = layout_.packed() ? common[static_cast<std::size_t>(node.bus)] : single;
      frame.id = layout_.frame_id(number, node.slot);
      frame.size = static_cast<std::uint8_t>(layout_.frame_size(number, node.slot));
      frame.fd = layout_.fd();
      layout_.encode(number, node.slot, commands_[j], frame);
      const bool whole = !layout_.packed() || node.slot.index + 1 == node.slot.count;
      if (whole) outbox(node.bus).add(frame);
    }
  }
  if (changed) since_refresh_ = 0;
  sent_ = commands_;
}

void CanMaster::send_heartbeat() {
  constexpr std::int64_t kMillisecond_ns = 1'000'000;
  if (now_ns_ - heartbeat_ns_ < can_->heartbeat_ms * kMillisecond_ns) return;
  heartbeat_ns_ = now_ns_;
  const auto node = static_cast<std::uint8_t>(can_->master_node);
  const CanFrame heartbeat = heartbeat_frame(node, NmtState::kOperational);
  LoopBound<4> buses;
  for (int i = 0; i < buses_; ++i) {
    buses.tick();
    outbox(i).add(heartbeat);
  }
}

}  // namespace tactus::can
