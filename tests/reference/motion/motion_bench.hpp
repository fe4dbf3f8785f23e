// MotionBench: a reference generator of either space with its client and stores, used through its
// public interface only, for the tests that request any motion at any time.
#pragma once

#include <array>

#include "gateway/reference_client.hpp"
#include "kernel/math/so3.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "kernel/streams/generator_streams.hpp"
#include "tests/support/middle_of_range.hpp"

namespace tactus {

/// Repeatable random numbers; the state is the seed.
struct Dice {
  std::uint64_t state;
  std::uint64_t bits() {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return state >> 11;
  }
  /// Uniform in [lo, hi].
  double uniform(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(bits()) * 0x1p-53;
  }
  /// Uniform in 0..n-1.
  int below(int n) { return static_cast<int>(uniform(0.0, n - 1e-9)); }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  Vector3 vector() { return {uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)}; }
};

/// The point at which a test begins: the middle of every joint's range; a pose in front of the arm.
template <class Space>
typename Space::Point home_point();
template <>
inline JointSpace::Point home_point<JointSpace>() {
  JointSpace::Point home;
  home.q = middle_of_range();
  return home;
}
template <>
inline TaskSpace::Point home_point<TaskSpace>() {
  TaskSpace::Point home;
  home.x = {{0.4, 0.1, 0.5}, exp_so3({3.0, 0.2, -0.1})};
  return home;
}

template <class Space, int most = 24>
struct MotionBench {
  using Point = typename Space::Point;
  static constexpr int kWaypoints = most;

  double period_s;
  ChannelMemory<Space> channel;
  std::array<std::array<Waypoint<Space>, kWaypoints>, kStores> waypoints;
  ReferenceClient<Space> client{channel};
  ReferenceGenerator<Space> generator;
  typename ReferenceGenerator<Space>::Params params;
  Point home = home_point<Space>();

  explicit MotionBench(double period, OnlineMode online = OnlineMode::kLimit, Fields measured = 0)
      : period_s(period) {
    params.online = online;
    params.measured = measured;
    channel.settings.period_s = period_s;
    for (std::size_t i = 0; i < waypoints.size(); ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = kWaypoints;
    }
    static_cast<void>(start(home));
  }

  Status start(const Point& measured) { return generator.start(channel, params, measured); }
  /// Steps one cycle of a robot that is where the reference was.
  Status step() { return generator.step(period_s, out()); }
  Status step(const Point& measured) { return generator.step(period_s, measured); }
  /// The executive's call in every cycle in which it brakes, after the step.
  void brake(Status why, BrakeWay way = BrakeWay::kOnPath) { generator.brake(why, way); }
  const Point& out() const { return generator.reference(); }
  /// True if a trajectory is being executed, moving or at rest.
  bool executing() const { return generator.state() == ReferenceState::kTrajectoryExecution; }
  int cycles(double time_s) const { return static_cast<int>(time_s / period_s + 0.5); }

  /// Returns an empty trajectory that gives `fields` at each waypoint; null if no store is free.
  Trajectory<Space>* trajectory(Fields fields) {
    Trajectory<Space>* empty = client.acquire();
    if (empty == nullptr) return nullptr;
    empty->count = 0;
    empty->open = false;
    empty->fields = fields;
    empty->interpolation = Interpolation::kByFields;
    empty->header = {};
    empty->start_s = kStartAtOnce;
    empty->tolerances = {};
    return empty;
  }
  static Waypoint<Space>& add(Trajectory<Space>& trajectory, double time_s, const Point& point) {
    Waypoint<Space>& waypoint = trajectory.waypoints[trajectory.count++];
    waypoint = {time_s, point};
    return waypoint;
  }
  /// Sends a trajectory and returns its number; 0 if the client refused it. The functions below do
  /// the same for other requests.
  std::uint32_t send(Trajectory<Space>& trajectory) {
    std::uint32_t id = 0;
    return client.send(trajectory, id).ok() ? id : 0;
  }
  std::uint32_t send(const Point& point) {
    std::uint32_t id = 0;
    return client.send(point, id).ok() ? id : 0;
  }
  std::uint32_t cancel() {
    std::uint32_t id = 0;
    return client.cancel(id).ok() ? id : 0;
  }
  std::uint32_t pause() {
    std::uint32_t id = 0;
    return client.pause(id).ok() ? id : 0;
  }
  std::uint32_t set_override(double rate) {
    std::uint32_t id = 0;
    return client.set_override(rate, id).ok() ? id : 0;
  }
  /// Takes every report there is and returns the latest one of request `id`; its number is 0 if
  /// there is none.
  Report report_of(std::uint32_t id) {
    Report found, report;
    while (client.poll(report)) {
      if (report.id == id) found = report;
    }
    return found;
  }
};

}  // namespace tactus
