// The rules of the paper's state machine written a second time, as what becomes of each request:
// the independent half of the interleaving test. Knows nothing of motion but when it has ended.
#pragma once

#include <array>

#include "kernel/reference/messages.hpp"

namespace tactus {

enum class Ask : std::uint8_t {
  kPoint,
  kTrajectory,  ///< can be joined from wherever the reference is
  kLater,       ///< the same, to begin in the cycle after the one that takes it
  kTooFast,     ///< admitted by the client, refused in the cycle
  kCancel,
  kHalf,  ///< override 0.5
  kPause,
  kResume,
};
inline constexpr int kAsks = 8;
inline constexpr std::array<const char*, kAsks> kAskWords = {
    "point", "trajectory", "later", "too fast", "cancel", "half", "pause", "resume"};

/// What was reported of one request, or should have been.
struct Fate {
  int started = 0, finals = 0;
  Outcome outcome = Outcome::kStarted;
  int store = -1;

  friend bool operator==(const Fate& a, const Fate& b) {
    return a.started == b.started && a.finals == b.finals && a.outcome == b.outcome &&
           a.store == b.store;
  }
};

class InterleavingModel {
 public:
  static constexpr int kMost = 8;  ///< requests of one case

  std::array<Fate, kMost> fates{};  ///< by the number of the request

  bool executing() const { return running_ >= 0; }
  bool paused() const { return paused_; }
  /// The point that stays the reference until told otherwise, or -1.
  int held_point() const { return held_; }
  /// The point that became the reference in this cycle, or -1.
  int new_point() const { return new_point_; }
  /// Whose position the motion ends at, or -1 for wherever it came to rest.
  int aim() const { return aim_; }
  /// The trajectory that was cancelled last, or -1.
  int canceled() const { return canceled_; }

  bool free(int store) const { return stores_[index(store)] == StoreState::kFree; }
  bool any_free() const { return free(0) || free(1) || free(2); }
  bool all_free() const { return free(0) && free(1) && free(2); }
  void send(int store) { stores_[index(store)] = StoreState::kTaken; }

  /// True if what waited for its time begins.
  bool begin_cycle() {
    pending_ = new_point_ = -1;
    const bool begins = waiting_ >= 0;
    if (begins) run(waiting_, waiting_store_);
    waiting_ = -1;
    return begins;
  }
  void take(Ask ask, int request, int store) {
    switch (ask) {
      case Ask::kPoint:
        return take_point(request);
      case Ask::kTrajectory:
        run(request, store);
        return end_waiting(Outcome::kSuperseded);
      case Ask::kLater:
        end_waiting(Outcome::kSuperseded);
        waiting_ = request;
        waiting_store_ = store;
        return;
      case Ask::kTooFast:
        return end(request, Outcome::kRefused, store);
      case Ask::kCancel:
        return take_cancel(request);
      case Ask::kPause:
      case Ask::kResume:
        paused_ = ask == Ask::kPause;
        [[fallthrough]];
      case Ask::kHalf:
        return end(request, Outcome::kExecuted, -1);
    }
  }
  /// False if a store should have come back in this cycle and did not.
  bool end_cycle() {
    if (pending_ >= 0) end(pending_, Outcome::kExecuted, -1);
    new_point_ = pending_;
    for (const StoreState state : stores_) {
      if (state == StoreState::kDue) return false;
    }
    return true;
  }
  /// A store was reported as released; false if the rules have none to release there.
  bool release(int store) {
    StoreState& state = stores_[index(store)];
    const bool expected = state == StoreState::kBraking || state == StoreState::kDue;
    state = StoreState::kFree;
    return expected;
  }
  /// The end of the running trajectory was reached.
  void arrive() {
    if (executing()) leave_path(Outcome::kSucceeded);
  }

 private:
  enum class StoreState : std::uint8_t { kFree, kTaken, kBraking, kDue };

  static std::size_t index(int i) { return static_cast<std::size_t>(i); }

  void end(int request, Outcome outcome, int store) {
    Fate& fate = fates[index(request)];
    ++fate.finals;
    fate.outcome = outcome;
    fate.store = store;
    if (store >= 0) stores_[index(store)] = StoreState::kFree;
  }
  void run(int request, int store) {
    leave_path(Outcome::kPreempted);
    fates[index(request)].started = 1;
    running_ = aim_ = request;
    running_store_ = store;
    held_ = -1;
  }
  void end_waiting(Outcome outcome) {
    if (waiting_ >= 0) end(waiting_, outcome, waiting_store_);
    waiting_ = -1;
  }
  /// Whatever was followed is followed no more.
  void leave_path(Outcome outcome) {
    if (executing()) end(running_, outcome, running_store_);
    running_ = -1;
    for (StoreState& state : stores_) {
      if (state == StoreState::kBraking) state = StoreState::kDue;
    }
  }
  void take_point(int request) {
    if (pending_ >= 0) end(pending_, Outcome::kSuperseded, -1);
    leave_path(Outcome::kAborted);
    pending_ = held_ = aim_ = request;
  }
  void take_cancel(int request) {
    if (!executing() && waiting_ < 0) return end(request, Outcome::kRefused, -1);
    end_waiting(Outcome::kCanceled);
    end(request, Outcome::kExecuted, -1);
    if (!executing()) return;
    end(running_, Outcome::kCanceled, -1);
    stores_[index(running_store_)] = StoreState::kBraking;
    canceled_ = running_;
    running_ = aim_ = -1;
  }

  std::array<StoreState, kStores> stores_{};
  bool paused_ = false;
  int running_ = -1, running_store_ = -1;
  int waiting_ = -1, waiting_store_ = -1;
  int pending_ = -1, new_point_ = -1, held_ = -1, aim_ = -1, canceled_ = -1;
};

}  // namespace tactus
