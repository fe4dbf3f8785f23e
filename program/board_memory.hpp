// BoardMemory: the objects of fixed size that every board on Linux owns in addition to its robot.
// They are the larger part of its memory figure.
#pragma once

#include <chrono>

#include "kernel/load/loader.hpp"
#include "program/session/session.hpp"

namespace tactus {

/// Memory for waypoints that nothing touches until they are sent: to construct them would take
/// longer than all else that a program does before its first line.
template <class Space, std::size_t kMost>
class WaypointMemory {
 public:
  Waypoint<Space>* data() { return reinterpret_cast<Waypoint<Space>*>(bytes_); }

 private:
  alignas(Waypoint<Space>) std::byte bytes_[kMost * sizeof(Waypoint<Space>)];
};

struct BoardMemory {
  static constexpr int kMaxPoses = 1 << 12;
  static constexpr int kMaxWaypoints = 1 << 15;  // 32 s at 1 kHz
  static constexpr std::size_t kRecorderNumbers = 1
                                                  << 17;  // in real time: a second of 100 at 1 kHz

  std::array<WaypointMemory<JointSpace, kMaxWaypoints>, kStores> waypoints;
  std::array<double, kRecorderNumbers> recorder_ring;
  std::array<WaypointMemory<TaskSpace, kMaxPoses>, kStores> poses;
  ChannelMemory<JointSpace> channel;
  ChannelMemory<TaskSpace> task_channel;
  RoomyPipeline pipeline;
  CycleTimes times;

  /// The channels with their stores. [init]
  Channels channels() {
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = kMaxWaypoints;
      task_channel.stores[i].waypoints = poses[i].data();
      task_channel.stores[i].capacity = kMaxPoses;
    }
    return {&channel, &task_channel};
  }
};

/// The stopwatch of execution times, ns. [cyclic]
inline std::uint64_t stopwatch_ns() {
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch() /
                                    std::chrono::nanoseconds(1));
}

}  // namespace tactus
