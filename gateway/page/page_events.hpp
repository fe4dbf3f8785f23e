// The messages of the gateway as JSON for browsers.
#pragma once

#include "gateway/page/event_ring.hpp"
#include "gateway/page/json.hpp"
#include "gateway/server/codec.hpp"
#include "gateway/server/cycle_mailboxes.hpp"

namespace tactus {

/// Monotonic times. Events carry seconds since `begin_ns`; a state also carries the time at which
/// it was sent, which a browser returns with its commands.
struct PageTime {
  std::int64_t begin_ns, now_ns;
};

/// Adds a message of the server to the events; those that the page does not show are left out.
/// [any]
void append_message(const tactus_ToClient& message, const PageTime& time, EventRing& events);

/// Appends the values of all outputs. [any]
void append_ports(const PortValues& values, const PortTable& ports, EventRing& events);

}  // namespace tactus
