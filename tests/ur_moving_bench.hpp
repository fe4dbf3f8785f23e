// An arm on its way at a controller made of bytes, what becomes of it, and that it recovers without
// motion.
#pragma once

#include "tests/ur_hal_bench.hpp"

namespace tactus::ur {

inline std::optional<UrHalBench> g_bench;

/// A bench whose arm is on its way.
inline UrHalBench& moving() {
  UrHalBench& bench = g_bench.emplace();
  ASSERT_OK(bench.start());
  bench.send_line();
  ASSERT_OK(bench.cycles(60));
  assert_true(bench.reference() > 0.01);
  return bench;
}

/// Cycles until one is not kOk; 0: none was.
inline int cycles_until_stopped(UrHalBench& bench, int most) {
  for (int i = 1; i <= most; ++i)
    if (bench.cycle() != Status::kOk) return i;
  return 0;
}

/// The last event walked the ladder because of the wire.
inline void assert_disabled_by_wire(UrHalBench& bench, Status expected) {
  ASSERT_STATUS(bench.executive.latched(), expected);
  assert_int_equal(static_cast<int>(bench.executive.rung()), static_cast<int>(Rung::kDisabled));
  Event event;
  const EventLog& events = bench.executive.events();
  assert_true(events.read(events.count() - 1, event));
  assert_int_equal(static_cast<int>(event.cause), static_cast<int>(Cause::kWire));
  ASSERT_STATUS(event.status, expected);
}

/// Nothing moves by itself; after a rearm the reference is where the arm is now, and stays.
inline void assert_recovers_without_motion(UrHalBench& bench) {
  const std::int32_t before = bench.hal.set_points();
  for (int i = 0; i < 5; ++i) assert_true(bench.run_cycle() != Status::kOk);
  assert_true(bench.robot.count() <= before);  // no set-point, an end at most
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    const double timestamp_s = bench.robot.image.timestamp_s;
    bench.robot.image = FakeImage();
    bench.robot.image.timestamp_s = timestamp_s > 0.0 ? timestamp_s : 0.0;
    bench.robot.image.q[0] = 0.7;
  }
  bench.robot.by_itself();
  ASSERT_OK(bench.executive.rearm());
  bench.robot.by_hand();
  ASSERT_OK(bench.drain());
  ASSERT_OK(bench.cycles(20));
  ASSERT_NEAR(bench.reference(), 0.7, 1e-12);
  ASSERT_NEAR(bench.robot.set_point(bench.hal.set_points())[0], 0.7, 1e-12);
}

}  // namespace tactus::ur
