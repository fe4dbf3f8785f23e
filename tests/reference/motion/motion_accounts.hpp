// MotionAccounts: checks that a client gets one final outcome of each request, and every store
// back.
#pragma once

#include <array>

#include "kernel/streams/stream_messages.hpp"

namespace tactus {

enum class Asked : std::uint8_t { kNothing, kTrajectory, kPoint, kOther };

class MotionAccounts {
 public:
  static constexpr std::size_t kMost = 8192;  ///< requests that one account holds

  void open() {
    asked_.fill(Asked::kNothing);
    finals_.fill(0);
    away_.fill(false);
    wrong_ = nullptr;
    sent_ = open_ = 0;
    trajectories_ = points_ = {};
  }
  bool full() const { return sent_ + 64 > static_cast<int>(kMost); }

  void sent(std::uint32_t id, Asked what, int store = -1) {
    if (id >= kMost || asked_[id] != Asked::kNothing) return complain("a number given twice");
    asked_[id] = what;
    ++sent_;
    not_sent(true, what);
    ++open_;
    if (store >= 0) away_[static_cast<std::size_t>(store)] = true;
  }

  /// Counts a motion that was wanted but not sent.
  void not_sent(bool it_is, Asked what) {
    if (what == Asked::kTrajectory) trajectories_.asked += it_is;
    if (what == Asked::kPoint) points_.asked += it_is;
  }

  void told(const Report& report) {
    if (report.store >= 0) returned(static_cast<std::size_t>(report.store));
    const Outcome outcome = report.outcome;
    if (outcome == Outcome::kReleased) return;
    if (report.id >= kMost || asked_[report.id] == Asked::kNothing)
      return complain("a report of nothing that was asked");
    const Asked what = asked_[report.id];
    const bool trajectory = what == Asked::kTrajectory;
    if (outcome == Outcome::kScheduled || outcome == Outcome::kStarted ||
        outcome == Outcome::kStarved) {
      if (!trajectory || finals_[report.id] > 0) complain("begun after its end");
      if (outcome == Outcome::kStarted) ++trajectories_.executed;
      return;
    }
    const bool done = outcome == Outcome::kExecuted, never = outcome == Outcome::kRefused;
    const bool replaced = outcome == Outcome::kSuperseded;
    if (trajectory ? done : !(done || never || replaced)) complain("an outcome of another kind");
    if (++finals_[report.id] != 1) complain("told twice");
    if (what == Asked::kPoint && (done || replaced)) ++points_.executed;
    --open_;
  }

  /// Returns the first thing that is wrong, or null.
  const char* wrong() const { return wrong_; }
  /// The number of requests without a final outcome, and of stores that did not come back.
  int open_requests() const { return open_; }
  int stores_away() const {
    int away = 0;
    for (const bool store : away_) away += store;
    return away;
  }
  /// The number of motions wanted, and of trajectories that began or points that were taken.
  struct Motions {
    int asked = 0, executed = 0;
  };
  const Motions& trajectories() const { return trajectories_; }
  const Motions& points() const { return points_; }

 private:
  void complain(const char* what) {
    if (wrong_ == nullptr) wrong_ = what;
  }
  void returned(std::size_t store) {
    if (store >= away_.size() || !away_[store]) return complain("a store given back twice");
    away_[store] = false;
  }

  std::array<Asked, kMost> asked_{};
  std::array<std::uint8_t, kMost> finals_{};
  std::array<bool, kStores> away_{};
  const char* wrong_ = nullptr;
  Motions trajectories_, points_;
  int sent_ = 0, open_ = 0;
};

}  // namespace tactus
