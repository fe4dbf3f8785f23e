#include "boards/program/log_writer.hpp"

#include <cstdio>
#include <cstring>
#include <ctime>

namespace tactus {
namespace {

constexpr std::size_t kStack = 256 * 1024;  // the default of 8 MiB would be locked in memory
constexpr timespec kBetween = {0, 5 * 1000 * 1000};  // a fraction of what the ring holds

}  // namespace

bool LogWriter::start() {
  pthread_attr_t attributes;
  const sched_param none{};
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStack);
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  pthread_attr_setschedpolicy(&attributes, SCHED_OTHER);
  pthread_attr_setschedparam(&attributes, &none);
  const int error = pthread_create(&thread_, &attributes, run, this);
  pthread_attr_destroy(&attributes);
  if (error != 0) std::fprintf(stderr, "the log's thread: %s\n", std::strerror(error));
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
    nanosleep(&kBetween, nullptr);
  }
}

}  // namespace tactus
