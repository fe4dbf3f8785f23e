// The requests of a tape's client.
#include "kernel/math/so3.hpp"
#include "tests/wcet/player.hpp"

namespace tactus {
namespace {

/// The pose that a tape refers to by number, or null.
const Pose* pose_of(const PortTable& ports, int number) {
  for (int i = 0; i < ports.count(); ++i)
    if (ports[i].quantity == Quantity::kPose && number-- == 0)
      return static_cast<const Pose*>(ports[i].value);
  return nullptr;
}

/// A pose of the base as seen in a frame.
Pose seen_from(const Pose& frame, const Pose& pose) {
  const Eigen::Quaterniond back = frame.r.conjugate();
  return {back * (pose.p - frame.p), back * pose.r};
}

template <class Vector>
void take_vector(Bytes& tape, Vector& vector) {
  for (int i = 0; i < vector.size(); ++i) vector[i] = tape.take<double>();
}

void take_values(Bytes& tape, JointSpace::Point& point) {
  for (JointVector* value : {&point.q, &point.dq, &point.ddq, &point.tau})
    take_vector(tape, *value);
}

void take_values(Bytes& tape, TaskSpace::Point& point) {
  take_vector(tape, point.x.p);
  Eigen::Quaterniond& r = point.x.r;
  for (double* part : {&r.w(), &r.x(), &r.y(), &r.z()}) *part = tape.take<double>();
  for (Vector6* value : {&point.v, &point.a, &point.h, &point.dh}) take_vector(tape, *value);
}

}  // namespace

/// Two pose numbers, 0 for none: the motion frame's in the low half, the wrench's in the high half.
TaskSpace::Header Player::take_terms(std::uint8_t frames) const {
  return {pose_of(pipeline_.ports, (frames & 15) - 1), pose_of(pipeline_.ports, (frames >> 4) - 1)};
}

/// i8 x 6: offset from the reference, 2 mm and 8 mrad at most per axis. Then, if `fields` has them,
/// i8 x 6 each: velocity in 127ths of 1 m/s and 1 rad/s, acceleration of 1 m/s^2 and 1 rad/s^2,
/// wrench in N and 0.1 N m.
TaskSpace::Point Player::near_reference(const TaskSpace::Header& header, Fields fields) {
  Vector6 beside, scale;
  const auto take = [this](Vector6& to, double linear, double angular) {
    for (int i = 0; i < 6; ++i) to[i] = (i < 3 ? linear : angular) * tape_.take<std::int8_t>();
  };
  take(beside, 0.002, 0.008);
  TaskSpace::Point point;
  const Pose base = reference_ != nullptr ? *reference_ : Pose();
  point.x = {base.p + beside.head<3>(), exp_so3(beside.tail<3>()) * base.r};
  if (header.motion != nullptr) point.x = seen_from(*header.motion, point.x);
  if (fields & kVelocityField) take(point.v, 1.0 / 127.0, 1.0 / 127.0);
  if (fields & kAccelerationField) take(point.a, 1.0 / 127.0, 1.0 / 127.0);
  if (fields & kEffortField) take(point.h, 1.0, 0.1);
  return point;
}

/// u8 frames, u8 fields, then the point.
void Player::take_point() {
  const TaskSpace::Header header = take_terms(tape_.take<std::uint8_t>());
  const Fields fields = tape_.take<std::uint8_t>() & 7;
  std::uint32_t id = 0;
  note(poses_.client.send(near_reference(header, fields), id, header));
}

/// u8 frames, u8 fields (bit 3: open), u8 interpolation, i8 start: 0 at once, else cycles from now;
/// u8 waypoints - 1, modulo 8; for each u8 time, at least 4 ms after the previous one, then the
/// point.
void Player::take_trajectory() {
  const auto frames = tape_.take<std::uint8_t>(), fields = tape_.take<std::uint8_t>(),
             how = tape_.take<std::uint8_t>();
  const auto start = tape_.take<std::int8_t>();
  const int count = tape_.take<std::uint8_t>() % 8 + 1;
  Trajectory<TaskSpace>* const trajectory = poses_.client.acquire();
  const double period_s = pipeline_.robot.period_s();
  Trajectory<TaskSpace> unused;
  Trajectory<TaskSpace>& to = trajectory != nullptr ? *trajectory : unused;
  to.header = take_terms(frames);
  to.fields = fields & 7;
  to.open = (fields & 8) != 0;
  to.interpolation = static_cast<Interpolation>(how % 5);
  const double now_s = static_cast<double>(executive_.telemetry().cycles) * period_s;
  to.start_s = start == 0 ? kStartAtOnce : now_s + start * period_s;
  to.count = count;
  double time_s = 0.0;
  for (int i = 0; i < count; ++i) {
    const int step = tape_.take<std::uint8_t>();
    time_s += i == 0 && step == 0 ? 0.0 : 0.004 * step + period_s / 16.0;
    const Waypoint<TaskSpace> waypoint = {time_s, near_reference(to.header, to.fields)};
    if (trajectory != nullptr) to.waypoints[i] = waypoint;
  }
  std::uint32_t id = 0;
  if (trajectory == nullptr) return;
  const Verdict verdict = poses_.client.send(to, id);
  if (verdict.ok()) poses_.sent = trajectory;
  note(verdict);
}

/// u8 frames, in joint space 256 waypoints each, u8 fields, u8 interpolation, u8 further waypoints,
/// f64 start; for each f64 time and its values.
template <class Space>
void Player::send_waypoints(TapeClient<Space>& to) {
  Trajectory<Space>* const trajectory = to.client.acquire();
  const auto frames = tape_.take<std::uint8_t>(), fields = tape_.take<std::uint8_t>(),
             how = tape_.take<std::uint8_t>(), rest = tape_.take<std::uint8_t>();
  const int count = rest + (std::is_same_v<Space, JointSpace> ? 256 * frames : 0);
  const auto start_s = tape_.take<double>();
  if constexpr (std::is_same_v<Space, TaskSpace>) {
    if (trajectory != nullptr) trajectory->header = take_terms(frames);
  } else {
    if (trajectory != nullptr) trajectory->header.held = 0;
  }
  for (int i = 0; i < count; ++i) {
    Waypoint<Space> waypoint;
    waypoint.time_s = tape_.take<double>();
    take_values(tape_, waypoint.point);
    if (trajectory != nullptr && i < trajectory->capacity) trajectory->waypoints[i] = waypoint;
  }
  if (trajectory == nullptr) return;
  trajectory->count = count;
  trajectory->open = false;
  trajectory->fields = fields & 7;
  trajectory->interpolation = static_cast<Interpolation>(how % 5);
  trajectory->start_s = start_s;
  std::uint32_t id = 0;
  const Verdict verdict = to.client.send(*trajectory, id);
  if (verdict.ok()) to.sent = trajectory;
  note(verdict);
}

void Player::take_waypoints() {
  if (pipeline_.takes_poses)
    send_waypoints(poses_);
  else
    send_waypoints(joints_);
}

/// Repeats the last waypoint of the last trajectory, a little later; an odd byte ends the
/// trajectory there.
void Player::take_append() {
  const auto byte = tape_.take<std::uint8_t>();
  if (poses_.sent == nullptr || poses_.sent->count < 1) return;
  Waypoint<TaskSpace> waypoint = poses_.sent->at(poses_.sent->count - 1);
  waypoint.time_s += 0.002 * byte;
  std::uint32_t id = 0;
  note(poses_.client.append(*poses_.sent, waypoint));
  note(poses_.client.flush(*poses_.sent, (byte & 1) != 0, id));
}

}  // namespace tactus
