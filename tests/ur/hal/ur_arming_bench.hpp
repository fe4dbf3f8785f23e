// Arming against a controller made of bytes that fails, and arming again when it does not.
#pragma once

#include "tests/ur/hal/ur_hal_bench.hpp"

namespace tactus::ur {

inline UrHalBench& fresh() {
  return g_bench.emplace();
}

/// The fault is over: the next arming ends with the arm where it is, and it stays there.
inline void assert_arms_now(UrHalBench& bench, bool reconnects) {
  {
    const std::lock_guard<std::mutex> lock(bench.robot.mutex);
    const double timestamp_s = bench.robot.image.timestamp_s;
    bench.robot.faults = {};
    bench.robot.image = FakeImage();
    bench.robot.image.timestamp_s = timestamp_s;
  }
  if (reconnects) ASSERT_OK(bench.connect());
  ASSERT_STATUS(bench.cycle(), bench.executive.latched());  // the cause has gone
  ASSERT_OK(bench.arm());
  ASSERT_OK(bench.cycles(5));
  const std::array<double, 6> q = bench.robot.set_point(bench.hal.set_points());
  for (std::size_t i = 0; i < q.size(); ++i) ASSERT_NEAR(q[i], FakeImage().q[i], 1e-12);
}

/// Arms against one fault of the robot; its Status and reason.
inline void assert_refused(UrHalBench& bench, Status expected, const char* reason) {
  ASSERT_OK(bench.connect());
  ASSERT_STATUS(bench.arm(), expected);
  assert_true(bench.says(reason));
  assert_true(bench.drives_are(DriveState::kFault));
  bench.robot.settle();
  assert_true(bench.robot.count() <= 0);
}

}  // namespace tactus::ur
