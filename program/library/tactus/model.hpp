// Kinematics, gravity and inverse dynamics of the robot, as functions and as a block.
#pragma once

#include <tactus/core.hpp>

#include "kernel/model/forward_kinematics.hpp"
#include "kernel/model/gravity.hpp"
#include "kernel/model/inverse_dynamics.hpp"
#include "kernel/model/robot_model.hpp"
