// Listener: the sockets at which clients arrive, one for streams and one for datagrams.
#pragma once

#include "gateway/sockets/address.hpp"

namespace tactus {

class Listener {
 public:
  Listener() = default;
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener() { close(); }

  /// Opens both sockets; a Unix socket has mode 0600, and replaces one at which no process listens.
  /// Port 0 is any that is free. Without `datagrams` only that for streams. False: `why` names what
  /// is in the way. [init]
  bool open(const Address& address, bool datagrams, Message& why);
  void close();

  /// The address with the port that it has. [any]
  const Address& address() const { return address_; }
  int streams() const { return streams_; }
  int datagrams() const { return datagrams_; }  ///< -1: none are taken
  /// Accepts a client; -1: none waits. [any]
  int accept() const;

 private:
  bool open_local(Message& why);
  bool open_host(Message& why);

  Address address_;
  int streams_ = -1, datagrams_ = -1;
  bool bound_ = false, bound_datagrams_ = false;  // to paths, which are to be removed
};

}  // namespace tactus
