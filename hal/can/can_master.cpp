// CanMaster: the cycle: start, received frames, and the frames it sends.
#include "hal/can/can_master.hpp"

#include <algorithm>

#include "hal/cia402/hex.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::can {
namespace {

using cia402::ArmingPhase;
using cia402::hex;

constexpr int kLostHeartbeats = 3;    // after which a node is lost
constexpr int kMostUnanswered = 100;  // SYNCs whose feedback may come late, all at once
constexpr int kMostSurplus = 10;      // cycles in a row with a frame of feedback too many

}  // namespace

void CanMaster::connect(std::int64_t now_ns) {
  connected_ = false;
  why_ = {};
  conflict_ = -1;
  for (Outbox& outbox : out_) outbox.clear();
  for (Node& node : nodes_) {
    node.feedback = {};
    node.frames = node.unanswered = node.surplus = 0;
  }
  startup_.begin(*can_, *drive_, layout_, mode_, period_us_, buses_, now_ns);
}

Status CanMaster::connecting(std::int64_t now_ns) {
  TRY(startup_.advance(now_ns));
  cia402::Feedbacks feedbacks;
  for (std::size_t j = 0; j < kDof; ++j) {
    nodes_[j].feedback.forget_what_has_gone();
    feedbacks[j] = nodes_[j].feedback;
  }
  drives_.set_velocity_units(startup_.findings().velocity_units);
  TRY(drives_.attach(mode_, feedbacks, why_));
  sent_ = {};
  since_refresh_ = PdoLayout::kRefresh;
  now_ns_ = -1;
  releases_ = 0;
  carried_ = {};
  connected_ = true;
  return Status::kOk;
}

/// The drive whose number is in an identifier, null if there is none on the bus.
Node* CanMaster::drive_of(int bus, std::uint16_t id) {
  Node* found = nullptr;
  for (Node& node : nodes_)
    if (node.bus == bus && node.id() == (id & kMaxNode)) found = &node;
  return found;
}

/// Identifiers that only a master sends: `node` is the drive whose number is in it.
bool CanMaster::is_ours(const Node* node, std::uint16_t id) const {
  if (id == kNmtId || id == kSyncId || id == kHeartbeatBase + can_->master_node) return true;
  return node != nullptr && layout_.is_command(id, node->slot);
}

/// The bus of the present SDO request: another bus may have a drive with the same number.
int CanMaster::asked_bus() const {
  if (!connected_) return startup_.bus();
  return nodes_[static_cast<std::size_t>(carried_.joint)].bus;
}

void CanMaster::receive(int bus, const CanFrame& frame, std::int64_t now_ns) {
  Node* const node = drive_of(bus, frame.id);
  if (is_ours(node, frame.id)) conflict_ = frame.id;
  if (node == nullptr || frame.remote) return;
  switch (frame.id - node->id()) {
    case kTpdoBase[0]: return take_feedback(*node, frame);
    case kEmcyBase: return take_emergency(*node, frame);
    case kHeartbeatBase: node->heart.receive(frame, now_ns); return;
    case kSdoAnswerBase:
      if (bus == asked_bus()) sdo_.receive(frame, now_ns);
      return;
    default: return;
  }
}

/// Feedback of another size comes from another sender, or from a drive that lost its mapping.
void CanMaster::take_feedback(Node& node, const CanFrame& frame) {
  if (frame.size != layout_.feedback_size() || frame.fd != layout_.fd()) return;
  layout_.decode(frame, node.feedback);
  ++node.frames;
}

void CanMaster::take_emergency(Node& node, const CanFrame& frame) {
  if (frame.size != kEmergencySize) return;
  node.feedback.error_code = load<std::uint16_t>(frame.data, 0);
  node.feedback.emergency = node.feedback.emergency || node.feedback.error_code != 0;
}

Status CanMaster::read(const CycleTime& now, RobotState& state) {
  if (!connected_) return Status::kNotStarted;
  const bool first = now_ns_ < 0;
  now_ns_ = now.stamp_ns;
  if (first) {  // the clock of the cycles is not that of the start-up
    heartbeat_ns_ = now_ns_ - can_->heartbeat_ms * kMillisecond_ns;
    sampled_ns_ = now_ns_;
    const std::int64_t limit_ns = kLostHeartbeats * can_->heartbeat_ms * kMillisecond_ns;
    for (Node& node : nodes_) node.heart.start(node.id(), limit_ns, now_ns_);
  }
  cia402::Feedbacks feedbacks;
  LoopBound<kDof> nodes;
  for (std::size_t j = 0; j < kDof; ++j) {
    nodes.tick();
    judge(nodes_[j]);
    if (!first) count_feedback(nodes_[j]);
    nodes_[j].feedback.fresh = nodes_[j].frames > 0;
    feedbacks[j] = nodes_[j].feedback;
    nodes_[j].feedback.emergency = false;
    nodes_[j].frames = 0;
  }
  if (first)  // what it holds is of the start-up; from now on there is one sample per cycle
    for (cia402::DriveFeedback& feedback : feedbacks) feedback.fresh = true;
  drives_.watch(feedbacks, sampled_ns_);
  carry_request();
  drives_.show(state);
  return conflict_ < 0 ? Status::kOk : Status::kBusConflict;
}

Message CanMaster::trouble() const {
  if (!why_.empty()) return why_;
  if (conflict_ < 0) return drives_.why();
  Message text("identifier ");
  text << hex(static_cast<std::uint32_t>(conflict_))
       << " was sent by somebody else on the bus; there must be one master, and every node its own"
          " number";
  return text;
}

/// A node that was restarted, left "operational" or is silent has lost its settings or will not
/// follow; it can be used again after the next connect().
void CanMaster::judge(Node& node) {
  Status& lost = node.feedback.lost;
  if (lost != Status::kOk) return;
  const bool left = node.heart.known() && node.heart.state() != NmtState::kOperational;
  if (node.heart.boot_ups() > 0 || left) lost = Status::kConnectionLost;
  if (node.heart.is_lost(now_ns_)) lost = Status::kBusTimeout;
}

/// A drive answers every SYNC once. Late answers arrive together, and a bus may occasionally
/// duplicate one. More frames than that mean a second sender.
void CanMaster::count_feedback(Node& node) {
  const int surplus = node.frames - node.unanswered;
  node.surplus = surplus > 0 ? node.surplus + 1 : 0;
  node.feedback.made_up = std::max(0, std::min(node.frames, node.unanswered) - 1);
  if (surplus > 1 || node.surplus > kMostSurplus) conflict_ = kTpdoBase[0] + node.id();
  node.unanswered = surplus < 0 ? -surplus : 0;
}

/// Carries the SDO requests of the drives, one at a time.
void CanMaster::carry_request() {
  const cia402::ObjectRequest& request = drives_.request();
  if (request.number == 0 || request.number != carried_.number) {
    carried_ = request;
    if (request.number == 0) return;
    const auto [index, sub, bytes] = request.object;
    const std::uint8_t id = nodes_[static_cast<std::size_t>(request.joint)].id();
    if (request.writes) return sdo_.download(id, index, sub, request.value, bytes, now_ns_);
    return sdo_.upload(id, index, sub, now_ns_);
  }
  sdo_.advance(now_ns_);
  if (sdo_.progress() == Progress::kBusy) return;
  if (sdo_.progress() == Progress::kAborted)
    return drives_.answer(0, {status_of(sdo_.abort()), meaning(sdo_.abort())});
  drives_.answer(sdo_.value());
}

void CanMaster::write(const RobotCommand& command) {
  if (!connected_) return;
  drives_.step(command, commands_, now_ns_);
  for (Outbox& outbox : out_) outbox.clear();
  send_commands();
  send_heartbeat();
  CanFrame request;
  if (releases_ > 0)
    send_release();
  else if (!stop_strays() && sdo_.take(request))
    outbox(asked_bus()).add(request);
  LoopBound<4> buses;
  for (int i = 0; i < buses_; ++i) {
    buses.tick();
    outbox(i).add(sync_frame());
  }
  for (Node& node : nodes_)
    if (node.unanswered < kMostUnanswered) ++node.unanswered;
  sampled_ns_ = now_ns_;
}

/// On the way up or down the controlwords go out in every cycle: a frame that was lost must not let
/// a drive wait.
void CanMaster::send_commands() {
  const cia402::ArmingPhase phase = drives_.phase();
  const bool on_its_way =
      phase != cia402::ArmingPhase::kOff && phase != cia402::ArmingPhase::kArmed;
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

/// An SDO that writes 0 to 1016h:1: the drive no longer expects a heartbeat. The answer is ignored.
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
void CanMaster::send_release() {
  LoopBound<2 * kDof> left;
  while (releases_ > 0) {
    left.tick();
    const int joint = (releases_ - 1) / 2;
    const bool ends_watch = releases_-- % 2 == 0;
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
