// A moving arm at the fake controller, the reactions to a fault, and a recovery without motion.
#pragma once

#include "tests/ur/hal/ur_hal_bench.hpp"

namespace tactus::ur {

/// A bench whose arm is moving.
inline UrHalBench& moving() {
  UrHalBench& bench = g_bench.emplace();
  ASSERT_OK(bench.start());
  bench.send_line();
  ASSERT_OK(bench.cycles(60));
  assert_true(bench.reference() > 0.01);
  return bench;
}

/// Number of cycles until one is not kOk, or 0.
inline int cycles_until_stopped(UrHalBench& bench, int most) {
  for (int i = 1; i <= most; ++i)
    if (bench.cycle() != Status::kOk) return i;
  return 0;
}

/// The last change of rung was to disabled, for this cause.
inline void assert_disabled_by(UrHalBench& bench, Cause cause, Status expected) {
  ASSERT_STATUS(bench.executive.latched(), expected);
  assert_int_equal(static_cast<int>(bench.executive.rung()), static_cast<int>(Rung::kDisabled));
  const EventLog& events = bench.executive.events();
  Event event;
  std::uint32_t i = events.count();
  do {
    assert_true(i > 0 && events.read(--i, event));
  } while (event.from == event.to);
  assert_int_equal(static_cast<int>(event.cause), static_cast<int>(cause));
  ASSERT_STATUS(event.status, expected);
}
/// The robot has stopped, and the exchange goes on.
inline void assert_disabled_by_drive(UrHalBench& bench, Status expected) {
  assert_disabled_by(bench, Cause::kDrive, expected);
  RobotState state;
  ASSERT_OK(bench.hal.read({}, state));
  for (const Drive& drive : state.drives) {
    assert_int_equal(static_cast<int>(drive.state), static_cast<int>(DriveState::kFault));
    ASSERT_STATUS(drive.reason, expected);
  }
}
inline void assert_disabled_by_wire(UrHalBench& bench, Status expected) {
  assert_disabled_by(bench, Cause::kWire, expected);
}

/// The cause is over, and somebody has moved the arm.
inline void mend(UrHalBench& bench) {
  bench.robot.change([](FakeImage& image) {
    const double timestamp_s = image.timestamp_s;
    image = FakeImage();
    image.timestamp_s = timestamp_s > 0.0 ? timestamp_s : 0.0;
    image.q[0] = 0.7;
  });
}
/// The reference is where the arm is now, and stays.
inline void assert_stays_where_it_was_moved(UrHalBench& bench) {
  ASSERT_OK(bench.cycles(20));
  ASSERT_NEAR(bench.reference(), 0.7, 1e-12);
  ASSERT_NEAR(bench.robot.set_point(bench.hal.set_points())[0], 0.7, 1e-12);
}
/// Nothing moves by itself; after a stop of the robot the drives are armed on the same connection.
inline void assert_rearms_without_motion(UrHalBench& bench) {
  const std::int32_t before = bench.hal.set_points();
  const int connections = bench.robot.connections();
  for (int i = 0; i < 5; ++i) assert_true(bench.cycle() != Status::kOk);
  mend(bench);
  for (int i = 0; i < 5; ++i) assert_true(bench.cycle() != Status::kOk);
  bench.robot.settle();
  assert_true(bench.robot.count() <= before);  // no set-point, an end at most
  ASSERT_OK(bench.arm());
  assert_int_equal(bench.robot.connections(), connections);
  assert_stays_where_it_was_moved(bench);
}
/// The same after the wire was lost: arming is refused until it is opened again.
inline void assert_reconnects_without_motion(UrHalBench& bench) {
  const std::int32_t before = bench.hal.set_points();
  const Status lost = bench.executive.latched();
  for (int i = 0; i < 5; ++i) assert_true(bench.run_cycle() != Status::kOk);
  assert_true(bench.robot.count() <= before);
  ASSERT_STATUS(bench.executive.arm(), lost);
  mend(bench);
  ASSERT_OK(bench.start());
  assert_stays_where_it_was_moved(bench);
}

}  // namespace tactus::ur
