#include "program/results/log_writer.hpp"

#include <cstdio>
#include <cstring>
#include <ctime>

#include "hal/os/ordinary_thread.hpp"

namespace tactus {
namespace {

constexpr timespec kBetweenWrites = {0, 5 * 1000 * 1000};  // the ring holds many times as long

}  // namespace

bool LogWriter::start() {
  const int error = start_ordinary_thread(thread_, run, this);
  if (error != 0) std::fprintf(stderr, "cannot start the log thread: %s\n", std::strerror(error));
  return started_ = error == 0;
}

void LogWriter::begin(Recorder& recorder, Progress& progress) {
  recorder_ = &recorder;
  progress_ = &progress;
  state_.store(State::kWriting, std::memory_order_release);
}

void LogWriter::end() {
  if (!started_) return;
  state_.store(State::kEnd, std::memory_order_release);
  pthread_join(thread_, nullptr);
  started_ = false;
  if (recorder_ != nullptr) log_.drain(*recorder_);
}

void* LogWriter::run(void* writer) {
  static_cast<LogWriter*>(writer)->write();
  return nullptr;
}

void LogWriter::write() {
  double begin_s = 0.0;
  State state = State::kIdle;
  while (state != State::kEnd) {
    state = state_.load(std::memory_order_acquire);
    if (state == State::kWriting) {
      if (begin_s == 0.0) begin_s = wall_s();
      log_.drain(*recorder_);
      progress_->update(wall_s() - begin_s);
    }
    nanosleep(&kBetweenWrites, nullptr);
  }
}

}  // namespace tactus
