#include "sim_plant/drives/drive_arm.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::drives {
namespace {

// The velocity loop of a drive takes 3 ms or less on the inertia that its joint has at least.
constexpr double kServoGains[] = {400.0, 400.0, 200.0, 200.0, 40.0, 40.0, 25.0};
// Above the top speed of the robot's data sheet, by a fifth.
constexpr double kSpeedMargin = 1.2;
constexpr double kRatedShare_mNm[] = {3000.0, 500.0};  // of strong and of light joints
constexpr double kStrong_Nm = 30.0;

AxisSettings axis_settings(const DriveArmSettings& settings, std::size_t joint) {
  AxisSettings axis;
  axis.max_torque_Nm = robot_mjcf().drive_torque[joint];
  axis.max_speed_rad_s = kSpeedMargin * robot_mjcf().drive_speed[joint];
  axis.rated_mNm =
      static_cast<std::uint32_t>(kRatedShare_mNm[axis.max_torque_Nm > kStrong_Nm ? 0 : 1]);
  axis.gains.kv = kServoGains[std::min<std::size_t>(joint, 6)];
  axis.brake_release_s = settings.brake_release_s;
  axis.gravity_by_drive = settings.gravity_by_drive;
  return axis;
}

}  // namespace

Status DriveArm::load(const DriveArmSettings& settings, std::int64_t now_ns) {
  settings_ = settings;
  const Status status = arm_.load(settings.plant);
  if (status != Status::kOk) return status;
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
    DriveBus& bus = buses_[static_cast<std::size_t>(place.bus)];
    nodes_[i].load(node, bus.queue(), now_ns);
    nodes_[i].faults().seed(settings.seed, place.node);
    bus.add(nodes_[i]);
  }
  plant_ns_ = now_ns;
  sync_ns_ = now_ns - kNoSync_ns;
  periods_ = 0;
  synced_.fill(false);
  braked_.fill(true);
  held_q_ = arm_.q();
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
  return first != nullptr ? first->period_s() : 1e-3;
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
      node(i).receive_sync(frame, now_ns, sample(i));
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

JointSample DriveArm::sample(int joint) const {
  return {q_[joint], dq_[joint], gravity_[joint]};
}

/// Moves the arm by one period with the commands in force.
void DriveArm::move(std::int64_t now_ns) {
  const double period = period_s();
  ++periods_;
  for (int i = 0; i < kDof; ++i) {
    if (has_drive(i)) node(i).begin_period(sample(i), period, now_ns);
    const auto at = static_cast<std::size_t>(i);
    const bool braked = !has_drive(i) || node(i).axis().braked();
    if (braked && !braked_[at]) held_q_[i] = q_[i];
    braked_[at] = braked;
  }
  move_for(period);
  if (arm_.diverged()) recover();
  measure();
}

void DriveArm::measure() {
  q_ = arm_.q();
  dq_ = arm_.dq();
  bool needed = settings_.gravity_by_drive;
  for (int i = 0; i < kDof; ++i) needed = needed || (has_drive(i) && node(i).axis().braked());
  if (needed) gravity_ = arm_.gravity();
  for (int i = 0; i < kDof; ++i)
    if (has_drive(i)) node(i).measure(sample(i));
}

/// A motion that cannot be simulated ends where the arm was before, with every drive in fault.
void DriveArm::recover() {
  settings_.plant.initial_q = q_;
  if (arm_.load(settings_.plant) != Status::kOk) return;
  for (int i = 0; i < kDof; ++i)
    if (has_drive(i)) node(i).axis().trip();
}

}  // namespace tactus::drives
