// UrSections: the sections that this board adds to the pipeline's own.
#pragma once

#include "boards/robot_sections.hpp"
#include "hal/ur/ur_settings.hpp"

namespace tactus {

struct UrSections : RobotSections {
  ur::UrSettings ur;

  template <class Visitor>
  void describe(Visitor& visit) {
    HostSections::describe(visit);
    visit.section("ur", ur);
  }
};

}  // namespace tactus
