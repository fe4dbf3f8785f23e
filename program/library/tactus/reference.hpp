// The reference generators of joints and of the tool tip, as blocks, the channels through which
// they receive references, and the client that judges and sends them.
#pragma once

#include <tactus/core.hpp>

#include "gateway/reference_client.hpp"
#include "kernel/reference/blocks/joint_reference_generator.hpp"
#include "kernel/reference/blocks/task_reference_generator.hpp"
