// `tactus doctor` and `tactus jitter`: whether this host is fit for a real-time cycle, and how late
// it wakes one.
#pragma once

#include "program/session/options.hpp"

namespace tactus {

/// Prints finding, value and remedy of every host setting that matters. Returns the exit code:
/// kEndedOtherwise if a required setting hurts.
int doctor(const Options& options);

/// Measures the wake-up latency of the cycle clock, then that of cyclictest with the same period,
/// priority and CPU, and prints both. Returns the exit code.
int jitter(const Options& options);

}  // namespace tactus
