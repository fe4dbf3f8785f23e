// A node's report as text, as `tactus scan` prints it.
#pragma once

#include <cstdio>

#include "hal/can/node_report.hpp"

namespace tactus {

/// Prints what is known about a node, a line for each subject.
void print_node(std::FILE* out, int node, const can::NodeReport& report);

}  // namespace tactus
