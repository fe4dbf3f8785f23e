// OpenConnections: the sockets of the page's connections, and when each was accepted. The time-out
// of libmicrohttpd counts from the last byte: one that sends a byte now and then would keep its
// place for ever.
#pragma once

#include <array>
#include <cstdint>

#include "gateway/page/limits.hpp"

namespace tactus {

class OpenConnections {
 public:
  void add(int socket, std::int64_t now_ns);
  void remove(int socket);
  /// Has the time of a connection not run out any more: its stream of events has no end.
  void keep(int socket);
  /// Shuts those down that have taken too long; if there is no place for another, earlier. [any]
  void end_late(std::int64_t now_ns) const;

 private:
  struct Place {
    int socket = -1;
    std::int64_t since_ns = 0;
    bool kept = false;
  };

  Place* find(int socket);

  std::array<Place, kMostPageConnections> places_{};
};

}  // namespace tactus
