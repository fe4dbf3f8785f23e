// HostSections: the sections of a pipeline file that every board on Linux has beside the
// pipeline's own.
#pragma once

#include "gateway/gateway_section.hpp"
#include "hal/os/realtime_settings.hpp"
#include "program/session/expect_section.hpp"

namespace tactus {

struct HostSections {
  GatewaySection gateway;
  RealtimeSettings realtime;
  ExpectSection expect;

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.section("gateway", gateway);
    visit.section("realtime", realtime);
    visit.section("expect", expect);
  }
};

}  // namespace tactus
