// The command line of every board's program, as a plain struct. CLI11 stays behind this seam: it
// needs exceptions.
#pragma once

#include <cstdint>

namespace tactus {

enum class Verb : std::uint8_t { kRun, kCheck, kPorts, kDoctor, kJitter };

/// Exit codes of every program.
enum ExitCode : int { kSucceeded = 0, kEndedOtherwise = 1, kRefused = 2 };

struct Options {
  Verb verb = Verb::kRun;
  char pipeline[512] = "";
  char trajectory[512] = "";  ///< empty: the pipeline file's own
  char out[512] = "";         ///< empty: out/<pipeline>
  double duration_s = 0.0;    ///< 0: the verb's own choice
  std::uint64_t seed = 1;
  bool figure = true;
  bool realtime = false;  ///< cycles by the wall clock
  char root[512] = "";    ///< of the /proc and /sys that `doctor` looks at
  int cpu = -1;           ///< of `doctor` and `jitter`; -1: any
  int priority = 80;      ///< likewise
  int period_us = 1000;   ///< of `jitter`
};

/// Reads the command line. False: the program ends at once with `exit_code` (help was asked for, or
/// a bad option).
bool parse_options(int argc, char** argv, const char* board, Options& options, int& exit_code);

}  // namespace tactus
