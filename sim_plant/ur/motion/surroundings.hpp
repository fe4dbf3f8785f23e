// Surroundings: how the arm of an emulated controller is mounted, what it carries and can touch.
// The controller knows mounting and payload; the boxes it does not know.
#pragma once

#include "sim_plant/arm/plant_params.hpp"

namespace tactus::ur {

/// Stiffness of a surface, N/m. The simulated arm is rigid, the gears of a robot are not: three
/// joints of 2e4 to 4e4 N m/rad (an order of magnitude, from catalogues of harmonic drives) at 0.4
/// to 0.6 m leave some 3e4 N/m at the tip, in series with the 1e5 N/m of a simulated surface.
inline constexpr double kStiffness = 2e4;

struct Surroundings {
  Vector3 mounting = Vector3::Zero();  ///< of the base in the world: roll, pitch, yaw, rad
  double payload_kg = 0.0;
  Vector3 payload_com = Vector3::Zero();  ///< m, flange frame
  Vector3 tip = Vector3::Zero();          ///< centre of the ball that touches, m, flange frame
  double tip_radius = 0.01;               ///< of the ball, m
  Material material = {kStiffness};       ///< of all boxes
  Scene scene;                            ///< in the base frame of the controller
};

}  // namespace tactus::ur
