// The electronic data sheet of the emulated drives (CiA 306), written from their dictionary, for
// tools of other makers.
#pragma once

#include <cstdio>

namespace tactus::drives {

/// Writes the data sheet. False: the file does not take it. [init]
bool print_eds(std::FILE* file);

}  // namespace tactus::drives
