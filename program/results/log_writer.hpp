// LogWriter: a thread without priority that moves rows from the recorder's ring into the log while
// cycles run, so that no cycle waits for a file.
#pragma once

#include <pthread.h>

#include <atomic>

#include "program/results/progress.hpp"
#include "program/results/run_log.hpp"

namespace tactus {

class LogWriter {
 public:
  explicit LogWriter(RunLog& log) : log_(log) {}
  ~LogWriter() { end(); }
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Starts the thread, which waits for begin(). Call it before the calling thread is bound to a
  /// CPU, since threads inherit the binding. False: prints the reason to stderr. [init]
  bool start();
  /// Makes the thread the only reader of the ring. [init]
  void begin(Recorder& recorder, Progress& progress);
  /// Empties the ring and ends the thread. [any]
  void end();

 private:
  enum class State { kIdle, kWriting, kEnd };
  static void* run(void* writer);
  void write();

  RunLog& log_;
  Recorder* recorder_ = nullptr;
  Progress* progress_ = nullptr;
  std::atomic<State> state_{State::kIdle};
  pthread_t thread_{};
  bool started_ = false;
};

}  // namespace tactus
