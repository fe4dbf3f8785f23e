// TrajectoryFeed: sends the trajectory of a run and, of a file longer than the store, one part
// after the other. In lock-step the loop feeds between two cycles. In real time a thread without
// priority reads, judges and sends, so that no cycle waits for a file or for the admission of 20
// 000 waypoints, which takes many periods.
#pragma once

#include <pthread.h>

#include <atomic>

#include "kernel/core/mailbox.hpp"
#include "program/session/trajectory_input.hpp"

namespace tactus {

class TrajectoryFeed {
 public:
  TrajectoryFeed(Session& session, TrajectoryInput& input) : session_(session), input_(input) {}
  ~TrajectoryFeed() { end(); }
  TrajectoryFeed(const TrajectoryFeed&) = delete;
  TrajectoryFeed& operator=(const TrajectoryFeed&) = delete;

  /// Starts the thread if there is a trajectory. Call it before the calling thread is
  /// bound to a CPU. False: prints the reason to stderr. [init]
  bool start();
  /// Sends the trajectory, or has the thread send it. False: refused; prints the reason to stderr.
  bool begin();
  /// Takes the next report on the trajectory. False: there is none.
  bool poll(Report& report);
  /// Sends the next part unless the thread does; waits up to a tenth of a second for a pipe.
  FeedResult advance();
  /// True once a part was refused; the reason was printed to stderr.
  bool refused() const { return fed_.load(std::memory_order_acquire) == FeedResult::kRefused; }
  /// Ends the thread. [any]
  void end();

 private:
  enum class State : std::uint8_t { kIdle, kFeeding, kEnd };
  static void* run(void* feed);
  void work();
  void forward_reports();

  Session& session_;
  TrajectoryInput& input_;
  Mailbox<Report, 64> reports_;  // on the trajectory, from the thread
  std::atomic<State> state_{State::kIdle};
  std::atomic<FeedResult> fed_{FeedResult::kIdle};
  pthread_t thread_{};
  bool threaded_ = false, joined_ = true;
};

}  // namespace tactus
