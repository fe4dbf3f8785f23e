// A UR's HAL without an executive: the test requests what it likes, cycle by cycle.
#pragma once

#include "tests/ur/hal/ur_hal_bench.hpp"

namespace tactus::ur {

struct UrExchange : UrHalBench {
  CycleTime now;
  RobotState state;

  /// Connects; the drives are off.
  void open() {
    settings.connect_ms = 2000;  // however late on a host that is busy
    ASSERT_OK(connect());
    exchange(DriveRequest::kDisable);
  }
  /// One cycle without a new packet: what is read, and what is written.
  void exchange_without_packet(DriveRequest request, const JointVector& value) {
    ASSERT_OK(hal.wait(now));
    ASSERT_OK(hal.read(now, state));
    ASSERT_OK(hal.write({CommandMode::kPosition, value, request}));
    robot.settle();
  }
  void exchange(DriveRequest request, const JointVector& value) {
    robot.send_package();
    const double before = settings.packet_wait;
    settings.packet_wait = 500.0;  // it comes, however late on a host that is busy
    exchange_without_packet(request, value);
    settings.packet_wait = before;
  }
  void exchange(DriveRequest request) { exchange(request, state.q); }

  /// Exchanges until the drives are in a phase, or in any of a state.
  void exchange_until(DriveRequest request, DrivePhase phase) {
    for (int i = 0; i < kMost && hal.phase() != phase; ++i) exchange(request);
    assert_string_equal(name(hal.phase()), name(phase));
  }
  void exchange_until(DriveRequest request, DriveState wanted) {
    for (int i = 0; i < kMost && state.drives[0].state != wanted; ++i) exchange(request);
    assert_string_equal(name(state.drives[0].state), name(wanted));
  }
  /// The robot lacks everything that arming can get, and takes its time.
  void stop_robot() {
    settings.on_protective_stop = OnProtectiveStop::kRelease;
    settings.on_power_off = OnPowerOff::kPowerOn;
    const std::lock_guard<std::mutex> lock(robot.mutex);
    robot.faults.begins_late = 3;
    robot.image.safety_mode = robot.image.robot_mode = 3;
    robot.image.safety_bits = 4;
  }
  std::uint32_t runtime_state() {
    const std::lock_guard<std::mutex> lock(robot.mutex);
    return robot.image.runtime_state;
  }

  static constexpr int kMost = 200;  // cycles
};

inline std::optional<UrExchange> g_exchange;

inline int end_exchange(void** state) {
  g_exchange.reset();
  return end_bench(state);
}

}  // namespace tactus::ur
