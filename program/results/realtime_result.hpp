// RealtimeResult: wake-up latencies, page faults and granted settings of a run in real time, for
// summary.json and the screen.
#pragma once

#include <cstdio>

#include "hal/os/host.hpp"
#include "hal/os/realtime.hpp"
#include "kernel/core/histogram.hpp"

namespace tactus {

struct RealtimeResult {
  bool asked = false;            ///< false: the run was in virtual time
  RealtimeReport report;         ///< what the operating system granted
  Histogram latency;             ///< of the wake-ups, ns
  std::int64_t page_faults = 0;  ///< of the cycle's thread while cycles ran
};

using Complaint = Text<2047>;

/// Returns, in words, every refused step and every required setting of the host that is not in
/// order; empty if there is none.
Complaint complain(const RealtimeReport& steps, const HostReport& host);

/// Applies `settings`, looks at the host and prints the complaint to stderr. False: there is one
/// and the settings require that there is none.
bool prepare(Realtime& realtime, const RealtimeSettings& settings);

/// Writes `  "realtime": {...},` of summary.json.
void write_realtime(std::FILE* file, const RealtimeResult& result);
/// Prints the lines below the table of stages.
void print_realtime(const RealtimeResult& result);

}  // namespace tactus
