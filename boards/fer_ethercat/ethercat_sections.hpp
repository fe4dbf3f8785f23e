// EthercatSections: the sections that a board with drives on EtherCAT adds to the pipeline's own.
#pragma once

#include "hal/cia402/cia402_settings.hpp"
#include "hal/ethercat/ethercat_settings.hpp"
#include "program/session/host_sections.hpp"

namespace tactus {

struct EthercatSections : HostSections {
  ethercat::EthercatSettings ethercat;
  cia402::Cia402Settings cia402;

  /// A real robot does not start on a host that harms real time, unless the file says otherwise.
  EthercatSections() { realtime.required = Required::kRefuse; }

  template <class Visitor>
  void describe(Visitor& visit) {
    HostSections::describe(visit);
    visit.section("ethercat", ethercat);
    visit.section("cia402", cia402);
  }
};

}  // namespace tactus
