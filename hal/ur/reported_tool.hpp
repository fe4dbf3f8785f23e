// Compares the tool and the tip that a controller reports with those that the models assume.
//
// A pipeline file may leave mass and tip of the tool to the controller. The models then assume a
// bare flange, so payload and TCP of the controller must be zero. And the tip that the controller
// reports for the measured joints must be where this program's kinematics has it: otherwise the arm
// is another one, or its TCP is.
#pragma once

#include <cmath>

#include "hal/ur/ur_state.hpp"

namespace tactus::ur {

inline constexpr double kZeroPayload_kg = 0.01, kZeroTcp_m = 0.001;  ///< count as zero
/// Between the axes of the reported and the computed tip. A calibrated arm has some mrad.
inline constexpr double kTipAngle_rad = 0.02;

/// True if the file gives it, so that the program on the robot sets it. [any]
inline bool gives_payload(const Tool& given) {
  return !std::isnan(given.mass_kg);
}
inline bool gives_tcp(const Tool& given) {
  return !given.tip.p.hasNaN();
}

/// Compares what is in force without a program of ours: payload and TCP that `given` leaves to the
/// controller, as far as the controller reports them, then the tip. kMissingKey: `why` has the
/// lines to add to the file; kMismatch. [cyclic]
Status check_before_program(const Tool& given, const UrState& state, double tip_tolerance_m,
                            Message& why);

/// Returns how far the reported tip is from the computed one, with the TCP that the controller
/// reports; empty if it reports none, or the arm has no power. [cyclic]
Message tip_distance(const UrState& state);

/// Compares the tip while the program, which has set the TCP if `given` has it, runs. kMissingKey,
/// kMismatch. [cyclic]
Status check_with_program(const Tool& given, const UrState& state, double tip_tolerance_m,
                          Message& why);

}  // namespace tactus::ur
