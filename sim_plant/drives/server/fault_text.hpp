// Faults as text: "node=3 kind=emergency value=0x2310 at=1000 until=1010 p=0.5".
#pragma once

#include "sim_plant/drives/faults.hpp"

namespace tactus::drives {

/// Reads a fault. Returns null, or what is wrong with the text: a constant. [init]
const char* parse_fault(const char* text, Fault& fault);

/// The kinds that a fault may be of.
struct FaultNames {
  const char* const* names;
  std::size_t count;
};
/// As above for other kinds: `kind` is the place of the name. [init]
const char* parse_fault(const char* text, const FaultNames& names, std::size_t& kind, Fault& fault);

}  // namespace tactus::drives
