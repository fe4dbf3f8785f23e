// Runs cyclictest of the package rt-tests as a child process: an independent measurement of the
// same host.
#pragma once

#include "kernel/core/histogram.hpp"
#include "kernel/core/text.hpp"

namespace tactus {

struct CyclictestSettings {
  int period_us = 1000;
  int cycles = 1000;
  int priority = 80;  ///< 0: none
  int cpu = -1;       ///< -1: any
};

/// The shell command that runs cyclictest.
Text<255> cyclictest_command(const CyclictestSettings& settings);

/// Reads the output of cyclictest, histogram and totals, into `latency`, ns. The first line that is
/// neither numbers nor a comment becomes the complaint.
class CyclictestOutput {
 public:
  explicit CyclictestOutput(Histogram& latency) : latency_(latency) {}
  void read_line(std::string_view line);
  const Text<127>& complaint() const { return complaint_; }

 private:
  Histogram& latency_;
  int max_us_ = 0;
  Text<127> complaint_;
};

/// Runs cyclictest to its end. False: there is no result, and `complaint` has the reason.
bool run_cyclictest(const CyclictestSettings& settings, Histogram& latency, Text<127>& complaint);

}  // namespace tactus
