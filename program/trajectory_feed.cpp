#include "program/trajectory_feed.hpp"

#include <cstdio>
#include <cstring>
#include <ctime>

#include "hal/os/ordinary_thread.hpp"

namespace tactus {
namespace {

constexpr timespec kBetweenFeeds = {0, 2 * 1000 * 1000};  // the window holds many times as long
constexpr int kThreadWait_ms = 2, kLoopWait_ms = 100;

}  // namespace

bool TrajectoryFeed::start() {
  if (!input_.given()) return true;
  const int error = start_ordinary_thread(thread_, run, this);
  if (error != 0)
    std::fprintf(stderr, "cannot start the thread that reads the trajectory: %s\n",
                 std::strerror(error));
  threaded_ = error == 0;
  joined_ = !threaded_;
  return threaded_;
}

bool TrajectoryFeed::begin() {
  state_.store(State::kFeeding, std::memory_order_release);
  return threaded_ || send_input(session_, input_);
}

bool TrajectoryFeed::poll(Report& report) {
  return threaded_ ? reports_.take(report) : poll_report(session_, input_, report);
}

FeedResult TrajectoryFeed::advance() {
  const bool begun = state_.load(std::memory_order_relaxed) == State::kFeeding;
  if (threaded_ || !begun || refused()) return FeedResult::kIdle;
  const FeedResult fed = feed_input(session_, input_, kLoopWait_ms);
  fed_.store(fed, std::memory_order_release);
  return fed;
}

void TrajectoryFeed::end() {
  if (joined_) return;
  state_.store(State::kEnd, std::memory_order_release);
  pthread_join(thread_, nullptr);
  joined_ = true;
}

void* TrajectoryFeed::run(void* feed) {
  static_cast<TrajectoryFeed*>(feed)->work();
  return nullptr;
}

void TrajectoryFeed::work() {
  State state = State::kIdle;
  while (state == State::kIdle) {
    nanosleep(&kBetweenFeeds, nullptr);
    state = state_.load(std::memory_order_acquire);
  }
  if (state == State::kFeeding && !send_input(session_, input_))
    fed_.store(FeedResult::kRefused, std::memory_order_release);
  while (state_.load(std::memory_order_acquire) == State::kFeeding) {
    forward_reports();
    FeedResult fed = FeedResult::kIdle;
    if (!refused()) {
      fed = feed_input(session_, input_, kThreadWait_ms);
      fed_.store(fed, std::memory_order_release);
    }
    if (fed != FeedResult::kMore) nanosleep(&kBetweenFeeds, nullptr);
  }
}

void TrajectoryFeed::forward_reports() {
  Report report;
  while (reports_.space() > 0 && poll_report(session_, input_, report)) {
    if (report.id == input_.id) reports_.post(report);
  }
}

}  // namespace tactus
