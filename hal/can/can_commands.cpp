// CanMaster: the frames that it sends in a cycle.
#include "hal/can/can_master.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

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

/// An SDO that writes 0 to 1016h:1: no heartbeat of ours is to be missed. Nobody awaits the answer.
CanFrame CanMaster::unwatched_frame(std::uint8_t node) {
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(kSdoRequestBase + node);
  frame.size = kSdoSize;
  frame.data[0] = kDownload | kSizeGiven | kExpedited;
  store(frame.data, 1, kHeartbeatConsumer);
  frame.data[3] = 1;
  return frame;
}

/// One frame in a cycle, in the place of a request: the queue that holds the frames of a cycle
/// holds it too. A drive that is lost, or has not confirmed that it is disabled, keeps its watch.
void CanMaster::send_farewell() {
  LoopBound<2 * kDof> left;
  while (farewells_ > 0) {
    left.tick();
    const int joint = (farewells_ - 1) / 2;
    const bool ends_watch = farewells_-- % 2 == 0;
    const Node& node = nodes_[static_cast<std::size_t>(joint)];
    if (!drives_.confirmed(joint) || lost(joint)) continue;
    return outbox(node.bus).add(ends_watch ? unwatched_frame(node.id())
                                           : nmt_frame(NmtCommand::kPreOperational, node.id()));
  }
}

/// Process data, and the quick stop in it, does not reach a node that has left "operational". NMT
/// stop lets the drive's own reaction act (6007h, CiA 402-2), as for a lost connection. The nodes
/// take turns, in the place of a request. False: there is no such node.
bool CanMaster::stop_strays() {
  LoopBound<kDof> nodes;
  for (int i = 0; i < kDof; ++i) {
    nodes.tick();
    stray_ = stray_ + 1 < kDof ? stray_ + 1 : 0;
    const Node& node = nodes_[static_cast<std::size_t>(stray_)];
    const NmtState state = node.heart.state();
    const bool out_of_reach = state != NmtState::kOperational && state != NmtState::kStopped;
    if (!node.heart.known() || !out_of_reach || drives_.confirmed(stray_)) continue;
    outbox(node.bus).add(nmt_frame(NmtCommand::kStop, node.id()));
    return true;
  }
  return false;
}

void CanMaster::leave() {
  if (!connected_) return;
  connected_ = false;
  RobotCommand stop;
  stop.mode = mode_;
  drives_.step(stop, commands_, now_ns_);
  for (Outbox& outbox : out_) outbox.clear();
  since_refresh_ = PdoLayout::kRefresh;
  send_commands();
  for (int i = 0; i < buses_; ++i) outbox(i).add(sync_frame());
}

}  // namespace tactus::can
