// The command line of every board's program, as a plain struct. CLI11 stays behind this seam: it
// needs exceptions.
#pragma once

#include <cstdint>

namespace tactus {

enum class Verb : std::uint8_t { kRun, kCheck, kPorts };

/// Exit codes of every program.
enum ExitCode : int { kSucceeded = 0, kEndedOtherwise = 1, kRefused = 2 };

struct Options {
  Verb verb = Verb::kRun;
  char pipeline[512] = "";
  char trajectory[512] = "";  ///< empty: the pipeline file's own
  char out[512] = "";         ///< empty: out/<pipeline>
  double duration_s = 0.0;    ///< 0: until the trajectory has ended and settled
  std::uint64_t seed = 1;
  bool figure = true;
};

/// Reads the command line. False: the program ends at once with `exit_code` (help was asked for, or
/// a bad option).
bool parse_options(int argc, char** argv, const char* board, Options& options, int& exit_code);

}  // namespace tactus
