// HostSections: the sections of a pipeline file that every board on Linux has beside the
// pipeline's own.
#pragma once

#include "gateway/gateway_section.hpp"
#include "hal/os/realtime_settings.hpp"

namespace tactus {

struct HostSections {
  GatewaySection gateway;
  RealtimeSettings realtime;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.section("gateway", gateway);
    visit.section("realtime", realtime);
  }
};

}  // namespace tactus
