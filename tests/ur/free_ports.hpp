// Ports for an emulated controller that no other program of the host holds.
#pragma once

#include <unistd.h>

#include "sim_plant/ur/server/server.hpp"

namespace tactus::ur {

/// What is added to the ports of a controller at `address`: from `first` downwards, other ports in
/// every process, below those that the system gives to clients.
inline int free_offset(const char* address, int first) {
  constexpr int kBlock = 20, kBlocks = 400, kTries = 50;
  static Emulator emulator{Settings{}};
  Server probe(emulator);
  int offset = first;
  for (int i = 0; i < kTries; ++i) {
    offset = first - kBlock * ((getpid() + i) % kBlocks);
    if (probe.start(address, offset)) break;
  }
  return offset;
}

}  // namespace tactus::ur
