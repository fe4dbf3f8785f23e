// CanMaster: the configuration: names of the buses, the place of every drive, and the load of a
// cycle.
#include <cmath>

#include "hal/can/can_master.hpp"

namespace tactus::can {
namespace {

constexpr std::size_t kLongest = 15;  // characters of the name of a Linux interface

}  // namespace

Status CanMaster::configure(const CanSettings& can, const cia402::Cia402Settings& drive,
                            const Tool& tool, CommandMode mode, int period_us, int arming_ms) {
  can_ = &can;
  drive_ = &drive;
  mode_ = mode;
  period_us_ = period_us;
  why_ = {};
  layout_ = PdoLayout(mode, can.frames, can.commands);
  if (can.commands == Commands::kPacked && mode != CommandMode::kEffort) {
    why_ =
        Message("[can] commands = packed is for torques; use plain for positions and velocities");
    return Status::kBadValue;
  }
  if (period_us % 100 != 0) {
    why_ = Message("[robot] period_us is ");
    why_ << period_us << "; drives take multiples of 100 us (60C2h)";
    return Status::kNotOffered;
  }
  if (1000 * can.timeout_ms(period_us) <= 2 * period_us || 1000 * can.heartbeat_ms < period_us) {
    why_ = Message("[can] command_timeout_ms is ");
    why_ << can.command_timeout_ms << ", heartbeat_ms " << can.heartbeat_ms
         << "; the first must be more than two periods, the second one: [robot] period_us is "
         << period_us;
    return Status::kBadValue;
  }
  TRY(judge_identity());
  TRY(read_interfaces());
  TRY(place_joints());
  TRY(judge_load());
  return drives_.configure(drive, tool, period_us, arming_ms, why_);
}

/// Gives every joint its bus, node and place. Whole numbers, and no node twice on a bus.
Status CanMaster::place_joints() {
  std::array<Slot, kMaxBuses> places;
  for (Slot& place : places) place.count = 0;
  for (int j = 0; j < kDof; ++j) {
    Node& node = nodes_[static_cast<std::size_t>(j)];
    node = {};
    node.bus = static_cast<int>(can_->bus[j]) - 1;
    node.slot.node = static_cast<std::uint8_t>(can_->node[j]);
    why_ = Message("joint ");
    why_ << j + 1 << ": ";
    if (node.bus + 1 != can_->bus[j] || node.bus >= buses_) {
      why_ << "[can] bus is " << can_->bus[j] << "; the buses are 1 to " << buses_;
      return Status::kBadValue;
    }
    bool taken = node.id() == can_->master_node;
    for (int k = 0; k < j; ++k) {
      const Node& other = nodes_[static_cast<std::size_t>(k)];
      taken = taken || (other.bus == node.bus && other.id() == node.id());
    }
    if (node.id() != can_->node[j] || taken) {
      why_ << "[can] node is " << can_->node[j]
           << "; every drive of a bus, and the master, needs a whole number of its own";
      return Status::kBadValue;
    }
    Slot& place = places[static_cast<std::size_t>(node.bus)];
    if (place.count == 0) place.first_node = node.id();
    node.slot.index = place.count++;
  }
  for (Node& node : nodes_) {
    const Slot& place = places[static_cast<std::size_t>(node.bus)];
    node.slot.count = place.count;
    node.slot.first_node = place.first_node;
    if (!layout_.packed() || place.count <= layout_.capacity()) continue;
    why_ = Message("bus ");
    why_ << interface(node.bus) << ": a packed frame has room for " << layout_.capacity()
         << " drives, the bus has " << place.count;
    return Status::kTooLarge;
  }
  why_ = {};
  return Status::kOk;
}

/// The frames of one cycle of each bus. Occasional messages, heartbeats among them, use
/// what a cycle leaves free.
Status CanMaster::judge_load() {
  const BitRates rates = {can_->bitrate_kbit * 1e3,
                          layout_.fd() ? can_->data_bitrate_kbit * 1e3 : 0.0};
  const bool packs = mode_ == CommandMode::kEffort && !layout_.packed();
  for (int bus = 0; bus < buses_; ++bus) {
    BusLoad load(rates);
    load.add(0, 1.0, false);  // SYNC
    int joints = 0;
    for (const Node& node : nodes_) {
      if (node.bus != bus) continue;
      const bool first = joints++ == 0;
      load.add(layout_.feedback(node.slot).size);
      if (!layout_.packed() || first)
        load.add(layout_.frame_size(layout_.command_frames(), node.slot));
    }
    TRY(load.judge(interface(bus), joints, period_us_, can_->load_share, packs, why_));
  }
  return Status::kOk;
}

/// Commands, heartbeat, a request by SDO, and SYNC.
int CanMaster::cycle_frames(int bus) const {
  int frames = 3;
  for (const Node& node : nodes_)
    if (node.bus == bus && (!layout_.packed() || node.slot.index == 0))
      frames += layout_.command_frames();
  return frames;
}

int CanMaster::filters(int bus, std::array<CanFilter, kMaxFilters>& filters) const {
  std::size_t count = 0;
  const auto want = [&](int id) { filters[count++].id = static_cast<std::uint16_t>(id); };
  want(kNmtId);
  want(kSyncId);
  want(kHeartbeatBase + can_->master_node);
  for (const Node& node : nodes_) {
    if (node.bus != bus) continue;
    want(kEmcyBase + node.id());
    want(kTpdoBase[0] + node.id());
    want(kSdoAnswerBase + node.id());
    want(kHeartbeatBase + node.id());
    for (int number = 1; number <= layout_.command_frames(); ++number)
      if (!layout_.packed() || node.slot.index == 0) want(layout_.frame_id(number, node.slot));
  }
  return static_cast<int>(count);
}

/// Splits "can0 can1" at blanks.
Status CanMaster::read_interfaces() {
  std::string_view text = can_->interfaces;
  buses_ = 0;
  for (std::size_t rest = text.size(); rest > 0; rest = text.size()) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    if (word.empty()) break;
    TRY(judge_interface(word));
    interfaces_[static_cast<std::size_t>(buses_++)] = Name(word);
  }
  if (buses_ > 0) return Status::kOk;
  why_ = Message("[can] interfaces is missing; name the buses, for example: can0 can1 can2");
  return Status::kMissingKey;
}

Status CanMaster::judge_interface(std::string_view word) {
  why_ = Message("[can] interfaces has '");
  why_ << word << "'";
  if (word.find(',') != std::string_view::npos) {
    why_ << " with a comma; separate names by blanks, for example: can0 can1 can2";
    return Status::kBadValue;
  }
  if (word.size() > kLongest) {
    why_ << ", which has " << word.size() << " characters; an interface has at most " << kLongest
         << ": `ip -brief link` lists them";
    return Status::kTooLarge;
  }
  if (buses_ == kMaxBuses) {
    why_ << " after " << kMaxBuses << " others; there are at most " << kMaxBuses << " buses";
    return Status::kTooLarge;
  }
  for (int bus = 0; bus < buses_; ++bus) {
    if (std::string_view(interfaces_[static_cast<std::size_t>(bus)]) != word) continue;
    why_ << " twice; every bus has an interface of its own";
    return Status::kBadValue;
  }
  why_ = {};
  return Status::kOk;
}

Status CanMaster::judge_identity() {
  for (const double number : {can_->vendor, can_->product}) {
    if (std::floor(number) == number) continue;
    why_ = Message("[can] vendor or product is ");
    why_ << number << "; 1018h:1 and :2 are whole numbers";
    return Status::kBadValue;
  }
  return Status::kOk;
}

}  // namespace tactus::can
