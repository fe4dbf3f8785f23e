// LogWriter: a thread without priority that moves rows from the recorder's ring into the log while
// cycles run, so that no cycle waits for a file.
#pragma once

#include <pthread.h>

#include <atomic>

#include "boards/program/progress.hpp"
#include "boards/program/run_log.hpp"

namespace tactus {

class LogWriter {
 public:
  explicit LogWriter(RunLog& log) : log_(log) {}
  ~LogWriter() { end(); }
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Starts the thread, which waits for begin(). To be called before the calling thread is bound to
  /// a CPU, since threads inherit that. False with a message on the error stream. [init]
  bool start();
  /// From now on the thread is the one reader of the ring. [init]
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
