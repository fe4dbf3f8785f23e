// The sections that boards with a real robot add to the pipeline's own.
#pragma once

#include "program/session/host_sections.hpp"

namespace tactus {

/// The sections of the host. A real robot does not start on a host that harms real time, unless the
/// file says otherwise.
struct RobotSections : HostSections {
  RobotSections() { realtime.required = Required::kRefuse; }
};

}  // namespace tactus
