// What a shell says of a program that it was to run.
#pragma once

namespace tactus {

inline constexpr int kProgramNotFound = 127;  ///< exit code

}  // namespace tactus
