// CanSections: the sections that a board with drives on CAN adds to the pipeline's own.
#pragma once

#include "hal/can/can_settings.hpp"
#include "hal/cia402/cia402_settings.hpp"
#include "program/session/host_sections.hpp"

namespace tactus {

struct CanSections : HostSections {
  can::CanSettings can;
  cia402::Cia402Settings cia402;

  /// A real robot does not start on a host that harms real time, unless the file says otherwise.
  CanSections() { realtime.required = Required::kRefuse; }

  template <class Visitor>
  void describe(Visitor& visit) {
    HostSections::describe(visit);
    visit.section("can", can);
    visit.section("cia402", cia402);
  }
};

}  // namespace tactus
