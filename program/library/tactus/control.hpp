// The laws, as blocks: PD with gravity compensation, PID, Cartesian pose, admittance, and the front
// end of a force/torque sensor.
#pragma once

#include <tactus/core.hpp>

#include "kernel/control/admittance.hpp"
#include "kernel/control/cartesian_pose.hpp"
#include "kernel/control/pd_gravity.hpp"
#include "kernel/control/pid.hpp"
#include "kernel/control/wrench_front_end.hpp"
