// UrSections: the sections that this board adds to the pipeline's own.
#pragma once

#include "hal/ur/ur_settings.hpp"
#include "program/session/host_sections.hpp"

namespace tactus {

struct UrSections : HostSections {
  ur::UrSettings ur;

  /// A real robot does not start on a host that harms real time, unless the file says otherwise.
  UrSections() { realtime.required = Required::kRefuse; }

  template <class Visitor>
  void describe(Visitor& visit) {
    HostSections::describe(visit);
    visit.section("ur", ur);
  }
};

}  // namespace tactus
