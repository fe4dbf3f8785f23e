// Faults as text: "node=3 kind=emergency value=0x2310 at=1000 until=1010 p=0.5".
#pragma once

#include "sim_plant/drives/faults.hpp"

namespace tactus::drives {

/// Reads a fault. Returns null, or what is wrong with the text: a constant. [init]
const char* parse_fault(const char* text, Fault& fault);

}  // namespace tactus::drives
