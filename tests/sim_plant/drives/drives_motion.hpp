// Shared by the tests of the arm behind the emulated drives.
#pragma once

#include <cmath>

#include "tests/sim_plant/drives/drives_bench.hpp"

namespace tactus::drives {

inline constexpr double kIncrement = 6.28318530717958647693 / 16777216.0;  // rad
inline constexpr double kLsb_Nm[] = {3e-3, 3e-3, 3e-3, 3e-3, 0.5e-3, 0.5e-3, 0.5e-3};

inline std::int16_t permille(int joint, double tau_Nm) {
  return static_cast<std::int16_t>(std::lround(tau_Nm / kLsb_Nm[joint]));
}
inline void hold_gravity(DrivesBench& bench) {
  const JointVector g = bench.arm.arm().gravity();
  for (int i = 0; i < kDof; ++i) bench.torque[static_cast<std::size_t>(i)] = permille(i, g[i]);
}
inline double farthest(DrivesBench& bench, const JointVector& from) {
  return (bench.arm.arm().q() - from).cwiseAbs().maxCoeff();
}
inline bool all_are(const DrivesBench& bench, unsigned mask, unsigned word) {
  for (const Feedback& f : bench.feedback)
    if ((f.status & mask) != word) return false;
  return true;
}

/// Torque commands that move every joint a little.
inline void swing(DrivesBench& bench, const JointVector& g, int k) {
  for (int i = 0; i < kDof; ++i) {
    const double size = i < 4 ? 3.0 : 0.5;
    bench.torque[static_cast<std::size_t>(i)] = permille(i, g[i] + size * std::sin(0.05 * k + i));
  }
}

}  // namespace tactus::drives
