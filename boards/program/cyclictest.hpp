// cyclictest of the package rt-tests, run as a child: what others measure on the same host.
#pragma once

#include "kernel/histogram.hpp"
#include "kernel/text.hpp"

namespace tactus {

struct CyclictestSettings {
  int period_us = 1000;
  int cycles = 1000;
  int priority = 80;  ///< 0: none
  int cpu = -1;       ///< -1: any
};

/// The command line of the shell that is run.
Text<255> cyclictest_command(const CyclictestSettings& settings);

/// Reads its output, histogram and totals, into `latency`, ns. What is no number and no comment
/// goes into `complaint`, the first such line.
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

/// Runs it to its end. False: `complaint` says why there is nothing.
bool run_cyclictest(const CyclictestSettings& settings, Histogram& latency, Text<127>& complaint);

}  // namespace tactus
