// LoadGenerator: runs stress-ng as a child process beside a measurement.
#pragma once

#include <sys/types.h>

#include "kernel/core/text.hpp"
#include "program/session/options.hpp"

namespace tactus {

class LoadGenerator {
 public:
  LoadGenerator() = default;
  ~LoadGenerator();
  LoadGenerator(const LoadGenerator&) = delete;
  LoadGenerator& operator=(const LoadGenerator&) = delete;

  /// False: stress-ng is not installed or does not run, and `complaint` has the reason.
  static bool installed(Text<127>& complaint);
  /// Starts the load and gives it time to begin. It ends with this program, also if that is killed.
  /// False: `complaint` has the reason.
  bool start(const Load& load, Text<127>& complaint);
  /// Ends the load. False: it had ended before, and `complaint` has the reason.
  bool stop(Text<127>& complaint);

 private:
  pid_t process_ = -1;
};

/// The loads as the option names them, "cpu, disk".
Text<31> names_of(const Load& load);

}  // namespace tactus
