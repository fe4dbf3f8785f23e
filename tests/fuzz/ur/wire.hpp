// Replaces the other end of hal/net/socket.hpp by a tape; wire.cpp is linked in place of the
// socket.
#pragma once

#include "tests/fuzz/fuzzing.hpp"

namespace tactus::fuzz {

struct Wire {
  const Tape* tape = nullptr;
  std::size_t at = 0;

  void play(const Tape& from) {
    tape = &from;
    at = 0;
  }
};
extern Wire wire;

}  // namespace tactus::fuzz
