// DriveSections: the sections of a board with CiA 402 drives on a bus.
#pragma once

#include "boards/robot_sections.hpp"
#include "hal/cia402/cia402_settings.hpp"

namespace tactus {

/// `Bus`: the settings of the bus, whose section is Bus::kSection.
template <class Bus>
struct DriveSections : RobotSections {
  Bus bus;
  cia402::Cia402Settings cia402;

  template <class Visitor>
  void describe(Visitor& visit) {
    HostSections::describe(visit);
    visit.section(Bus::kSection, bus);
    visit.section("cia402", cia402);
  }
};

}  // namespace tactus
