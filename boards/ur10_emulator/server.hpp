// Server: the sockets of an emulated controller. One thread, nothing blocks: a client that does not
// read or write costs its own buffer and no time.
#pragma once

#include <poll.h>

#include "sim_plant/ur/emulator.hpp"

namespace tactus::ur {

class Server {
 public:
  explicit Server(Emulator& emulator) : emulator_(emulator) {}
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server() { stop(); }

  /// Listens on all ports of a controller at `address`, each moved by `port_offset`. False: one
  /// cannot be had, and errno says why. [init]
  bool start(const char* address, int port_offset);
  void stop();

  /// Waits at most `timeout_ns` for clients and passes on all that has come. [any]
  void pump(std::int64_t timeout_ns);
  /// Sends what the cycle has left for the clients. [cyclic]
  void flush();

 private:
  struct Door {
    std::uint16_t port;
    Service service;
    bool reads;  ///< what the client sends; else it is thrown away
    int socket = -1;
  };
  struct Guest {
    int socket = -1;
    int session = -1;
    bool reads = true;
  };

  int build_poll_list();
  void let_in(Door& door);
  bool read_some(Guest& guest);
  void read_from(Guest& guest);
  void write_to(Guest& guest);
  void show_out(Guest& guest);
  void serve_link(std::size_t i, short events);
  void connect_link(std::size_t i);
  void close_link(std::size_t i);

  static constexpr std::size_t kDoors = 8;
  static constexpr std::size_t kGuests = static_cast<std::size_t>(Emulator::kSessions);

  Emulator& emulator_;
  std::array<Door, kDoors> doors_{{{kDashboardPort, Service::kDashboard, true},
                                   {kPrimaryPort, Service::kPrimary, true},
                                   {kSecondaryPort, Service::kSecondary, true},
                                   {kRealtimePort, Service::kRealtime, true},
                                   {kRtdePort, Service::kRtde, true},
                                   {30011, Service::kPrimary, false},
                                   {30012, Service::kSecondary, false},
                                   {30013, Service::kRealtime, false}}};
  std::array<Guest, kGuests> guests_;
  std::array<int, Links::kCount> link_sockets_;
  std::array<pollfd, kDoors + kGuests + Links::kCount> polled_;
};

}  // namespace tactus::ur
