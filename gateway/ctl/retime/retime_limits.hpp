// The limits within which retime may move a robot: of its table or, of the pipeline that is served,
// of the server.
#pragma once

#include <string>
#include <vector>

#include "gateway/ctl/options.hpp"
#include "gateway/ctl/output.hpp"
#include "gateway/ctl/retime/numbers.hpp"
#include "gateway/ctl/row_reader.hpp"

namespace tactus::ctl {

struct RobotLimits {
  std::string robot;
  std::vector<JointName> joints;
  MotionBounds joint, tip;  ///< tip: empty if the pipeline that is served takes no poses
  Numbers lowest, highest;  ///< of the joints, rad
};

/// Finds the limits that the options select. Returns the exit code; unless it is kSucceeded, the
/// reason is printed.
int find_limits(const Options& options, Output& output, RobotLimits& limits);

}  // namespace tactus::ctl
