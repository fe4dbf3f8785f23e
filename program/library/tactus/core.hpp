// What all of Tactus is made of: vectors, limits, statuses, ports, and Hal, the interface to a
// robot. Include the robot's header, <tactus/fer.hpp> for example, before this one.
#pragma once

#ifndef TACTUS_ROBOT
#error "include the header of the robot first, for example <tactus/fer.hpp>"
#endif

#include <tactus_version.h>
#include "kernel/core/hal.hpp"
#include "kernel/core/joint_limits.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/task_limits.hpp"
#include "kernel/core/verdict.hpp"
