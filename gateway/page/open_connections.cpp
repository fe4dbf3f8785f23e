#include "gateway/page/open_connections.hpp"

#include <sys/socket.h>

#include <algorithm>

namespace tactus {

OpenConnections::Place* OpenConnections::find(int socket) {
  const auto at = std::find_if(places_.begin(), places_.end(),
                               [&](const Place& place) { return place.socket == socket; });
  return at != places_.end() ? &*at : nullptr;
}

void OpenConnections::add(int socket, std::int64_t now_ns) {
  if (Place* const place = find(-1)) *place = {socket, now_ns, false};
}

void OpenConnections::remove(int socket) {
  if (Place* const place = find(socket)) *place = {};
}

void OpenConnections::keep(int socket) {
  if (Place* const place = find(socket)) place->kept = true;
}

/// libmicrohttpd reads the end of a socket that is shut down, and closes it.
void OpenConnections::end_late(std::int64_t now_ns) const {
  const bool full = std::none_of(places_.begin(), places_.end(),
                                 [](const Place& place) { return place.socket < 0; });
  const std::int64_t longest_ns = full ? kCrowdedRequest_ns : kLongestRequest_ns;
  for (const Place& place : places_)
    if (place.socket >= 0 && !place.kept && now_ns - place.since_ns > longest_ns)
      ::shutdown(place.socket, SHUT_RDWR);
}

}  // namespace tactus
