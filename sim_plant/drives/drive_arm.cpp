#include "sim_plant/drives/drive_arm.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::drives {
Status DriveArm::load(const DriveArmSettings& settings, std::int64_t now_ns) {
  settings_ = settings;
  DrivenArm::Axes axes{};
  for (DriveBus& bus : buses_) bus.clear();
  for (std::size_t i = 0; i < kDof; ++i) {
    const DriveArmSettings::Place& place = settings.joints[i];
    if (place.node == 0) continue;
    if (place.bus < 0 || place.bus >= static_cast<int>(kBuses)) return Status::kBadValue;
    if (place.node < 0 || place.node > can::kMaxNode) return Status::kBadValue;
    NodeSettings node;
    node.node = static_cast<std::uint8_t>(place.node);
    node.fd = settings.fd;
    node.axis = axis_settings(settings, i);
    node.boot_ns = settings.boot_ns;
    node.store_ns = settings.store_ns;
    node.starts = settings.start;
    DriveBus& bus = buses_[static_cast<std::size_t>(place.bus)];
    nodes_[i].load(node, bus.queue(), now_ns);
    nodes_[i].faults().seed(settings.seed, place.node);
    bus.add(nodes_[i]);
    axes[i] = &nodes_[i].axis();
  }
  plant_ns_ = now_ns;
  sync_ns_ = now_ns - kNoSync_ns;
  synced_.fill(false);
  TRY(driven_.load(settings, axes));
  measure();
  return Status::kOk;
}

bool DriveArm::add(const Fault& fault) {
  bool room = true;
  for (int i = 0; i < kDof; ++i)
    if (has_drive(i)) room = node(i).faults().add(fault) && room;
  return room;
}

bool DriveArm::has_drive(int joint) const {
  return settings_.joints[static_cast<std::size_t>(joint)].node != 0;
}

double DriveArm::period_s() const {
  const Node* first = nullptr;
  for (int i = kDof; i-- > 0;)
    if (has_drive(i) && (first == nullptr || nodes_[static_cast<std::size_t>(i)].operational()))
      first = &nodes_[static_cast<std::size_t>(i)];
  return first != nullptr ? first->axis().period_s() : 1e-3;
}

void DriveArm::receive(std::size_t bus, const can::CanFrame& frame, std::int64_t now_ns) {
  if (buses_[bus].is_sync(frame)) return receive_sync(bus, frame, now_ns);
  for (Node* node : buses_[bus]) node->receive(frame, now_ns);
}

void DriveArm::receive_sync(std::size_t bus, const can::CanFrame& frame, std::int64_t now_ns) {
  sync_ns_ = now_ns;
  const bool begins = synced_[bus] || std::none_of(synced_.begin(), synced_.end(),
                                                   [](bool synced) { return synced; });
  if (begins) {
    move(now_ns);
    plant_ns_ = now_ns;
    synced_.fill(false);
  }
  synced_[bus] = true;
  for (int i = 0; i < kDof; ++i)
    if (has_drive(i) &&
        settings_.joints[static_cast<std::size_t>(i)].bus == static_cast<int>(bus) &&
        node(i).sync_id() == frame.id)
      node(i).receive_sync(frame, now_ns, driven_.sample(i));
}

void DriveArm::advance(std::int64_t now_ns) {
  const auto period_ns = static_cast<std::int64_t>(std::llround(period_s() * 1e9));
  if (now_ns - sync_ns_ >= kNoSync_ns) {
    for (int n = 0; now_ns - plant_ns_ >= period_ns; ++n) {
      plant_ns_ = n < kMostAtOnce ? plant_ns_ + period_ns : now_ns;
      move(plant_ns_);
    }
  }
  for (int i = 0; i < kDof; ++i)
    if (has_drive(i)) node(i).advance(now_ns);
}

/// Moves the arm by one period with the commands in force.
void DriveArm::move(std::int64_t now_ns) {
  const double period = period_s();
  for (int i = 0; i < kDof; ++i)
    if (has_drive(i)) node(i).begin_period(driven_.sample(i), period, now_ns);
  driven_.move(period);
  measure();
}

void DriveArm::measure() {
  for (int i = 0; i < kDof; ++i)
    if (has_drive(i)) node(i).measure(driven_.sample(i));
}

}  // namespace tactus::drives
