// The rules of the paper's state machine written a second time, as the outcome of each request: the
// independent half of the interleaving test. Of the motion it knows only when it has ended.
#pragma once

#include <array>

#include "kernel/streams/stream_messages.hpp"

namespace tactus {

enum class Ask : std::uint8_t {
  kPoint,
  kTrajectory,  ///< can be joined from any state of the reference
  kLater,       ///< the same, to begin in the cycle after the one that takes it
  kTooFast,     ///< admitted by the client, refused in the cycle
  kOpen,        ///< a trajectory to which more will be appended
  kFeed,        ///< one more waypoint for the last open trajectory
  kLast,        ///< the same, and none will follow
  kCancel,
  kHalf,  ///< override 0.5
  kPause,
  kResume,
};
inline constexpr std::array<const char*, 11> kAskWords = {
    "point", "trajectory", "later", "too fast", "open",  "feed",
    "last",  "cancel",     "half",  "pause",    "resume"};

/// True if the request is a control: these are answered in the next cycle before all others.
constexpr bool is_control(Ask ask) {
  return ask >= Ask::kCancel;
}
constexpr bool carries_store(Ask ask) {
  return ask >= Ask::kTrajectory && ask <= Ask::kOpen;
}
constexpr bool extends(Ask ask) {
  return ask == Ask::kFeed || ask == Ask::kLast;
}

/// The reports of one request, as received or as expected.
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
  static constexpr int kMost = 10;  ///< requests of one case

  std::array<Fate, kMost> fates{};  ///< by the number of the request

  bool executing() const { return running_ >= 0; }
  int waiting() const { return waiting_; }
  /// True if a request was sent before the last cancel, which voids it unless it was taken.
  bool voids(int request) const { return request < cancel_; }
  bool paused() const { return paused_; }
  /// True if the running or the waiting trajectory can be extended.
  bool open() const {
    return (executing() && open_[index(running_store_)]) ||
           (waiting_ >= 0 && open_[index(waiting_store_)]);
  }
  /// The point that stays the reference until the next request, or -1.
  int held_point() const { return held_; }
  /// The point that became the reference in this cycle, or -1.
  int new_point() const { return new_point_; }
  /// True if a point has been taken in this cycle.
  bool point_taken() const { return pending_ >= 0; }
  /// The request at whose position the motion ends, or -1 if it comes to rest elsewhere.
  int aim() const { return aim_; }
  /// The trajectory that was cancelled last, or -1.
  int canceled() const { return canceled_; }

  bool free(int store) const { return stores_[index(store)] == StoreState::kFree; }
  bool any_free() const { return free(0) || free(1) || free(2); }
  bool all_free() const { return free(0) && free(1) && free(2); }
  void send(int store, bool open) {
    stores_[index(store)] = StoreState::kTaken;
    open_[index(store)] = open;
  }

  /// `due`: the waiting trajectory begins.
  void begin_cycle(bool due) {
    pending_ = new_point_ = -1;
    if (!due) return;
    run(waiting_, waiting_store_);
    waiting_ = -1;
  }
  /// The executive brakes from now on.
  void refuse_all() {
    refusing_ = true;
    end_waiting(Outcome::kAborted);
    give_up(Outcome::kAborted);
  }
  /// `alone`: every request sent that is no control has been taken.
  void control(Ask ask, int request, bool alone) {
    if (refusing_) return end(request, Outcome::kRefused, -1);
    if (ask == Ask::kCancel) return take_cancel(request, alone);
    if (ask != Ask::kHalf) paused_ = ask == Ask::kPause;
    end(request, Outcome::kExecuted, -1);
  }
  void take(Ask ask, int request, int store) {
    if (refusing_) return end(request, Outcome::kRefused, carries_store(ask) ? store : -1);
    if (voids(request) && !extends(ask))
      return ask == Ask::kPoint ? end(request, Outcome::kSuperseded, -1)
                                : end(request, Outcome::kCanceled, store);
    switch (ask) {
      case Ask::kPoint: return take_point(request);
      case Ask::kTrajectory:
      case Ask::kOpen: run(request, store); return end_waiting(Outcome::kSuperseded);
      case Ask::kLater:
        end_waiting(Outcome::kSuperseded);
        waiting_ = request;
        waiting_store_ = store;
        return;
      case Ask::kTooFast: return end(request, Outcome::kRefused, store);
      case Ask::kFeed:
      case Ask::kLast: return take_more(request, store, ask == Ask::kLast);
      default: return;
    }
  }
  /// Ends the cycle; false if a store that should have come back has not.
  bool end_cycle() {
    if (pending_ >= 0) end(pending_, Outcome::kExecuted, -1);
    new_point_ = pending_;
    for (const StoreState state : stores_) {
      if (state == StoreState::kDue) return false;
    }
    return true;
  }
  /// Takes the report that a store was released; false if the rules do not expect it.
  bool release(int store) {
    StoreState& state = stores_[index(store)];
    const bool expected = state == StoreState::kBraking || state == StoreState::kDue;
    state = StoreState::kFree;
    return expected;
  }
  /// The running trajectory has reached its end.
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
    held_ = canceled_ = -1;
  }
  void end_waiting(Outcome outcome) {
    if (waiting_ >= 0) end(waiting_, outcome, waiting_store_);
    waiting_ = -1;
  }
  /// Ends the running trajectory; all stores still braked on are due.
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
    canceled_ = -1;
  }
  void take_more(int request, int store, bool last) {
    const bool known =
        (executing() && store == running_store_) || (waiting_ >= 0 && store == waiting_store_);
    const bool extended = known && open_[index(store)];
    end(request, extended ? Outcome::kExecuted : Outcome::kRefused, -1);
    if (extended) open_[index(store)] = !last;
  }
  /// Cancels a trajectory or the motion to a point, which is not reached within so few cycles.
  void take_cancel(int request, bool alone) {
    const bool goes = executing() || waiting_ >= 0 || held_ >= 0;
    if (!goes && alone) return end(request, Outcome::kRefused, -1);
    cancel_ = request;
    end_waiting(Outcome::kCanceled);
    end(request, Outcome::kExecuted, -1);
    if (goes) held_ = aim_ = -1;
    if (executing()) canceled_ = running_;
    give_up(Outcome::kCanceled);
  }
  /// Ends the running trajectory, which brakes on its path.
  void give_up(Outcome outcome) {
    if (!executing()) return;
    end(running_, outcome, -1);
    stores_[index(running_store_)] = StoreState::kBraking;
    running_ = aim_ = -1;
  }

  std::array<StoreState, kStores> stores_{};
  std::array<bool, kStores> open_{};
  bool paused_ = false, refusing_ = false;
  int cancel_ = -1;  // the last cancel that was not refused
  int running_ = -1, running_store_ = -1;
  int waiting_ = -1, waiting_store_ = -1;
  int pending_ = -1, new_point_ = -1, held_ = -1, aim_ = -1, canceled_ = -1;
};

}  // namespace tactus
