// The other end of hal/ur/socket.hpp is a tape: in its place wire.cpp is linked.
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
