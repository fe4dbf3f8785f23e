// The messages of the gateway as JSON for browsers.
#pragma once

#include "gateway/page/json.hpp"
#include "gateway/page/news.hpp"
#include "gateway/server/codec.hpp"
#include "gateway/server/cycle_mailboxes.hpp"

namespace tactus {

/// By the monotonic clock. Browsers are told seconds since `begin_ns`, and with a state when it was
/// told, which a browser gives with its commands.
struct PageTime {
  std::int64_t begin_ns, now_ns;
};

/// Adds a message of the server to the news; those that the page does not show are left out. [any]
void tell(const tactus_ToClient& message, const PageTime& time, News& news);

/// Adds the values of all outputs. [any]
void tell(const PortValues& values, const PortTable& ports, News& news);

}  // namespace tactus
