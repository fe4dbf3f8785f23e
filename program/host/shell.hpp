// The answer of a shell about a program that it was to run.
#pragma once

namespace tactus {

inline constexpr int kProgramNotFound = 127;  ///< exit code

}  // namespace tactus
