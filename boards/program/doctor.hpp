// `tactus doctor` and `tactus jitter`: is this host fit for a real-time cycle, and how late does it
// wake one?
#pragma once

#include "boards/program/options.hpp"

namespace tactus {

/// Prints one line for every item that matters: finding, value, remedy. kEndedOtherwise if one that
/// is required hurts.
int doctor(const Options& options);

/// Measures the wake-up latency of the cycle clock, then that of cyclictest with the same period,
/// priority and CPU, and prints both. The exit code.
int jitter(const Options& options);

}  // namespace tactus
