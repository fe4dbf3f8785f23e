// Address: where a server listens, "unix:PATH" or "tcp:ADDRESS:PORT".
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>

#include "kernel/core/text.hpp"

namespace tactus {

struct Address {
  bool local = true;   ///< a Unix socket
  sockaddr_un path{};  ///< of a Unix socket
  sockaddr_in host{};  ///< of TCP, and of UDP at the same port

  /// Reads an address. False: `why` names what is wrong with it. [init]
  bool parse(std::string_view text, Message& why);
  /// Writes it as it is read. [any]
  Text<127> text() const;
  /// True if only programs on this computer reach it. [any]
  bool loopback() const;
  /// The Unix socket for datagrams: beside that for streams, with this suffix.
  static constexpr std::string_view kDatagrams = ".datagrams";
};

/// Writes the address at which a server listens if it is given none: a Unix socket of this user.
/// [init]
Text<127> default_address();

}  // namespace tactus
