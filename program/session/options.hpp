// The command line of every board's program, as a plain struct. Only options.cpp includes CLI11,
// which needs exceptions.
#pragma once

#include <cstdint>

namespace tactus {

enum class Verb : std::uint8_t { kRun, kCheck, kPorts, kDoctor, kJitter, kScan, kServe };

/// Exit codes of every program.
enum ExitCode : int { kSucceeded = 0, kEndedOtherwise = 1, kRefused = 2 };

/// The load by stress-ng while `jitter` measures.
struct Load {
  bool cpu = false, memory = false, disk = false;

  bool any() const { return cpu || memory || disk; }
};

/// The options --set: keys that replace or extend those of the pipeline file.
struct OverrideOptions {
  static constexpr int kMost = 32;
  char texts[kMost][256] = {};  ///< "section.key=value"
  int count = 0;
};

struct Options {
  Verb verb = Verb::kRun;
  char pipeline[512] = "";
  char trajectory[512] = "";  ///< empty: the one named in the pipeline file
  char record[512] = "";      ///< of `run`: the MCAP file; empty: none
  char out[512] = "";         ///< empty: out/<pipeline>
  double duration_s = 0.0;    ///< 0: the default of the verb
  std::uint64_t seed = 1;
  OverrideOptions overrides;
  bool figure = true, log = true;
  bool realtime = false;          ///< cycles by the wall clock
  char listen[128] = "";          ///< of `serve`: the address; empty: a Unix socket of the user
  char http[64] = "";             ///< of `serve`: where the page is; empty: there is none
  bool virtual_time = false;      ///< of `serve`: late cycles delay the simulated robot
  std::int64_t rows = 1'000'000;  ///< of `serve`: longest log
  char key[512] = "";             ///< of `serve`: the key file; empty: none
  char root[512] = "";            ///< of `doctor`: the folder that contains proc and sys
  int cpu = -1;                   ///< of `doctor` and `jitter`; -1: any
  int priority = 80;              ///< of `doctor` and `jitter`
  int period_us = 1000;           ///< of `jitter`
  Load load;                      ///< of `jitter`
  static constexpr int kMostBuses = 8;
  char buses[kMostBuses][16] = {};  ///< of `scan`: the interfaces
  int bus_count = 0;                ///< of `scan`
  int answer_ms = 100;              ///< of `scan`: longest time for an answer
  char interface[16] = "";  ///< of `doctor`: the network interface of the robot; empty: none
};

/// Reads the command line. False: the program must end with `exit_code`, because help was requested
/// or an option is wrong. `has_bus`: the board has the verb `scan`.
bool parse_options(int argc, char** argv, const char* board, bool has_bus, Options& options,
                   int& exit_code);

}  // namespace tactus
