// Rung: a level of the degrade ladder (ladder.hpp). It has a header of its own for code that reads
// the rung and does not need the table.
#pragma once

#include <cstdint>

#include "kernel/core/names.hpp"

namespace tactus {

enum class Rung : std::uint8_t { kNominal, kSkipOptional, kHold, kStop, kArming, kDisabled };

constexpr const char* name(Rung rung) {
  switch (rung) {
    case Rung::kNominal: return "nominal";
    case Rung::kSkipOptional: return "skip_optional";
    case Rung::kHold: return "hold";
    case Rung::kStop: return "stop";
    case Rung::kArming: return "arming";
    case Rung::kDisabled: return "disabled";
  }
  return nullptr;
}

}  // namespace tactus
