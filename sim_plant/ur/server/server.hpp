// Server: the sockets of an emulated controller. It has one thread and never blocks: a client that
// does not read or write fills only its own buffer and costs no time.
#pragma once

#include <poll.h>

#include "sim_plant/ur/controller/emulator.hpp"

namespace tactus::ur {

class Server {
 public:
  explicit Server(Emulator& emulator) : emulator_(emulator) {}
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server() { stop(); }

  /// Listens on all ports of a controller at `address`, with `port_offset` added to each. False: a
  /// port is not available, and errno says why. [init]
  bool start(const char* address, int port_offset);
  void stop();

  /// Waits at most `timeout_ns` for clients and passes on all bytes that have come. [any]
  void pump(std::int64_t timeout_ns);
  /// Sends the packets of the cycle to the clients. [cyclic]
  void flush();

 private:
  struct Listener {
    std::uint16_t port;
    Service service;
    bool reads;  ///< whether bytes from the client are used; else they are dropped
    int socket = -1;
  };
  struct Connection {
    int socket = -1;
    int session = -1;
    bool reads = true;
    int port = 0;
  };

  int build_poll_list();
  void let_in(Listener& listener);
  int find_place(Service service);
  bool read_some(Connection& connection);
  void read_from(Connection& connection);
  void write_to(Connection& connection);
  void show_out(Connection& connection);
  void serve_link(std::size_t i, short events);
  void connect_link(std::size_t i);
  void close_link(std::size_t i);

  static constexpr std::size_t kDoors = 8;
  static constexpr std::size_t kGuests = static_cast<std::size_t>(Emulator::kSessions);

  Emulator& emulator_;
  std::array<Listener, kDoors> listeners_{{{kDashboardPort, Service::kDashboard, true},
                                           {kPrimaryPort, Service::kPrimary, true},
                                           {kSecondaryPort, Service::kSecondary, true},
                                           {kRealtimePort, Service::kRealtime, true},
                                           {kRtdePort, Service::kRtde, true},
                                           {30011, Service::kPrimary, false},
                                           {30012, Service::kSecondary, false},
                                           {30013, Service::kRealtime, false}}};
  std::array<Connection, kGuests> connections_;
  std::array<int, Links::kCount> link_sockets_;
  std::array<pollfd, kDoors + kGuests + Links::kCount> polled_;
};

}  // namespace tactus::ur
