// The messages of the gateway as JSON for browsers.
#pragma once

#include "gateway/page/json.hpp"
#include "gateway/page/news.hpp"
#include "gateway/server/codec.hpp"
#include "gateway/server/cycle_mail.hpp"

namespace tactus {

/// Adds a message of the server to the news; those that the page does not show are left out. A
/// state is told with the time `now_ms`, which a browser gives with its commands. [any]
void tell(const tactus_ToClient& message, std::int64_t now_ms, News& news);

/// Adds the values of all outputs. [any]
void tell(const PortValues& values, const PortTable& ports, News& news);

}  // namespace tactus
