// A simulated robot in torque mode, held by the torque that was measured when it was armed: the
// bench of the SimHal's tests.
#pragma once

#include <cmath>
#include <cstring>

#include "tests/sim_plant/arm/driven_hal.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr double kPeriod_s = 1e-3;

inline constexpr CommandMode kEffort = CommandMode::kEffort;

/// One robot, restarted by each test, because MuJoCo's memory outlives a failed assertion.
struct SimHalBench {
  SimHal hal;
  RobotState state;
  JointVector hold;  // N m, the torque measured at the start

  void start(const PlantParams& params, std::uint64_t seed = 1) {
    ASSERT_OK(hal.load(params, seed));
    hal.set_period(kPeriod_s);
    ASSERT_OK(arm_drives(hal, kEffort, state));
    hold = state.tau;
  }
  /// Runs one cycle with `tau` added to the torque that held the arm at the start.
  void cycle(const JointVector& tau) {
    ASSERT_OK(measure(hal, state));
    ASSERT_OK(follow(hal, kEffort, hold + tau));
  }
};

inline SimHalBench g_bench, g_twin;

inline PlantParams noisy() {
  PlantParams params;
  params.position_noise_rad = 1e-4;
  params.velocity_noise_rad_s = 1e-2;
  return params;
}

inline bool same_bytes(const JointVector& a, const JointVector& b) {
  return std::memcmp(a.data(), b.data(), sizeof(JointVector)) == 0;
}

/// A torque that changes from cycle to cycle, N m.
inline JointVector wave(int k) {
  return JointVector::Constant(2.0 * std::sin(0.05 * k));
}

}  // namespace tactus
