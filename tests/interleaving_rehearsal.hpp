// A reference generator and the model of its rules, brought through one order of requests side by
// side.
#pragma once

#include "tests/interleaving_case.hpp"
#include "tests/reference_bench.hpp"

namespace tactus {

/// One generator, its client, and the model that says what they should do.
class Rehearsal {
 public:
  /// The limits are tight, so that a step of a fraction of an acceleration shows as a jerk.
  explicit Rehearsal(OnlineMode mode) : mode_(mode) {
    bench_.params.online = mode;
    bench_.channel.settings.limits.ddq_max.setConstant(5.0);
    bench_.channel.settings.limits.dddq_max.setConstant(250.0);
  }

  /// Null, or what went otherwise than the rules say.
  const char* play(const Case& c) {
    complaint_ = nullptr;
    begin();
    bring_to(c.begin);
    for (int k = 0, next = 0; k < kCycles; ++k) {
      while (next < c.count && c.cycles[at(next)] == k) send(c.asks[at(next++)]);
      cycle(ReferenceBench::kPeriod_s);
    }
    for (int k = 0; k < 10; ++k) cycle(ReferenceBench::kPeriod_s);
    end();
    return complaint_;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void check(bool holds, const char* complaint) {
    if (!holds && complaint_ == nullptr) complaint_ = complaint;
  }

  /// A new start at home. What a former case left in the mailbox is refused and its stores freed.
  void begin() {
    check(bench_.start(bench_.home) == Status::kOk, "the generator starts");
    check(bench_.step() == Status::kOk, "the first cycle");
    Report report;
    while (bench_.client.poll(report)) {
      check(report.outcome == Outcome::kRefused, "what came before the start is refused");
    }
    model_ = InterleavingModel();
    reported_.fill({});
    asked_ = first_of_cycle_ = 0;
    cycles_ = 1;
    arrivals_expected_ = false;
  }
  void bring_to(Begin begin) {
    if (begin == Begin::kOnline) return;
    send(Ask::kTrajectory);
    cycle(ReferenceBench::kPeriod_s);
    cycle(0.25);
    if (begin == Begin::kExecuting) return;
    send(begin == Begin::kBraking ? Ask::kCancel : Ask::kPause);
    cycle(ReferenceBench::kPeriod_s);
    cycle(begin == Begin::kPaused ? 1.0 : 0.005);
  }

  /// `way` from home, moving on with `speed`; the first joint goes furthest.
  JointSpace::Point beside_home(double way, double speed) const {
    JointVector direction = JointVector::Constant(0.4);
    direction[0] = 1.0;
    JointSpace::Point point;
    point.q = bench_.home + way * direction;
    point.dq = speed * direction;
    return point;
  }
  JointSpace::Point point(int request) const { return beside_home(0.01 * (request + 1), 0.1); }
  double goal(int request) const { return 0.05 + 0.01 * request; }

  Verdict send_trajectory(Ask ask, std::uint32_t& id, int& store) {
    Trajectory<JointSpace>* motion = bench_.trajectory(kVelocityField | kAccelerationField);
    check((motion != nullptr) == model_.any_free(),
          "a store is to be had if and only if one is free");
    if (motion == nullptr) return {Status::kNoFreeStore};
    store = static_cast<int>(motion - bench_.channel.stores.data());
    check(model_.free(store), "the store acquired was free");
    if (ask == Ask::kTooFast) {
      bench_.add(*motion, 0.05, 0.5);
    } else {
      motion->waypoints[0] = {0.5, beside_home(0.5 * goal(asked_), 0.05)};
      motion->waypoints[1] = {1.0, beside_home(goal(asked_), 0.0)};
      motion->count = 2;
    }
    if (ask == Ask::kLater) motion->start_s = (cycles_ + 2) * ReferenceBench::kPeriod_s;
    model_.send(store);
    return bench_.client.send(*motion, id);
  }
  void send(Ask ask) {
    std::uint32_t id = 0;
    Verdict verdict;
    int store = -1;
    if (ask == Ask::kTrajectory || ask == Ask::kLater || ask == Ask::kTooFast) {
      verdict = send_trajectory(ask, id, store);
      if (verdict.status == Status::kNoFreeStore) return;
    } else if (ask == Ask::kPoint) {
      verdict = bench_.client.send(point(asked_), id);
    } else if (ask == Ask::kCancel) {
      verdict = bench_.client.cancel(id);
    } else if (ask == Ask::kHalf) {
      verdict = bench_.client.set_override(0.5, id);
    } else {
      verdict = ask == Ask::kPause ? bench_.client.pause(id) : bench_.client.resume(id);
    }
    check(verdict.ok(), "the client sends what it may");
    ids_[at(asked_)] = id;
    sent_[at(asked_)] = ask;
    begins_[at(asked_)] = cycles_ + 2;
    stores_[at(asked_)] = store;
    ++asked_;
  }

  /// A cycle makes one plan; what was asked after it waits for the next.
  bool plans(Ask ask) const {
    return ask == Ask::kTrajectory || ask == Ask::kTooFast ||
           (ask == Ask::kPoint && mode_ == OnlineMode::kLimit);
  }
  /// One that had to wait until its start time came is like any other.
  Ask taken_as(int request) const {
    const bool late = sent_[at(request)] == Ask::kLater && cycles_ + 1 >= begins_[at(request)];
    return late ? Ask::kTrajectory : sent_[at(request)];
  }

  void cycle(double dt_s) {
    const JointSpace::Point before = bench_.out();
    const int held = model_.held_point();
    bool planned = model_.begin_cycle();
    for (; first_of_cycle_ < asked_ && !planned; ++first_of_cycle_) {
      const Ask ask = taken_as(first_of_cycle_);
      model_.take(ask, first_of_cycle_, stores_[at(first_of_cycle_)]);
      planned = plans(ask);
    }
    check(bench_.step(dt_s) == Status::kOk, "a cycle");
    ++cycles_;
    Report report;
    while (bench_.client.poll(report)) take(report);
    check(model_.end_cycle(), "a store left behind comes back");
    check(model_.fates == reported_, "every request has the fate the rules say");
    check((bench_.generator.state() == ReferenceState::kTrajectoryExecution) == model_.executing(),
          "the state is that of the rules");
    check_output(before, held, dt_s);
  }
  void take(const Report& report) {
    if (report.outcome == Outcome::kReleased)
      return check(report.id == 0 && model_.release(report.store), "a store is released once");
    int request = 0;
    while (request < asked_ && ids_[at(request)] != report.id) ++request;
    if (request == asked_) return check(false, "a report has the id of its request");
    if (report.outcome == Outcome::kSucceeded && arrivals_expected_) model_.arrive();
    Fate& fate = reported_[at(request)];
    if (report.outcome == Outcome::kScheduled)
      return check(sent_[at(request)] == Ask::kLater && fate == Fate(), "it waits for its time");
    if (report.outcome == Outcome::kStarted)
      return ++fate.started, check(fate.finals == 0, "a start is reported before the end");
    ++fate.finals;
    fate.outcome = report.outcome;
    fate.store = report.store;
    check(report.verdict.ok() == (report.outcome != Outcome::kRefused), "a refusal says why");
  }

  void check_output(const JointSpace::Point& before, int held, double dt_s) {
    const JointSpace::Point& out = bench_.out();
    if (mode_ == OnlineMode::kForward && model_.new_point() >= 0)
      return check(same(out, point(model_.new_point())), "a point is forwarded as it came");
    if (mode_ == OnlineMode::kForward && held >= 0)
      return check(same(out, before), "a point is held");
    check(continuous(before, out, dt_s), "without a point nothing steps");
  }
  static bool same(const JointSpace::Point& a, const JointSpace::Point& b) {
    return a.q == b.q && a.dq == b.dq && a.ddq == b.ddq && a.tau == b.tau;
  }
  /// Within limits, and what one period brings is what velocity and acceleration promise.
  bool continuous(const JointSpace::Point& a, const JointSpace::Point& b, double dt) const {
    const JointLimits& limits = bench_.channel.settings.limits;
    constexpr double kOver = 1.0 + 1e-9, kRounding = 1e-12;
    for (int j = 0; j < kDof; ++j) {
      const double jerk = limits.dddq_max[j] * kOver;
      const double mean_dq = 0.5 * (a.dq[j] + b.dq[j]), mean_ddq = 0.5 * (a.ddq[j] + b.ddq[j]);
      const bool good = std::abs(b.dq[j]) <= limits.dq_max[j] * kOver &&
                        std::abs(b.ddq[j]) <= limits.ddq_max[j] * kOver &&
                        std::abs(b.ddq[j] - a.ddq[j]) <= jerk * dt + kRounding &&
                        std::abs(b.dq[j] - a.dq[j] - dt * mean_ddq) <= jerk * dt * dt + kRounding &&
                        std::abs(b.q[j] - a.q[j] - dt * mean_dq) <= jerk * dt * dt * dt + kRounding;
      if (!good) return false;
    }
    return true;
  }

  /// Paused, the motion stands and stays alive; resumed, it ends, and nothing is left behind.
  void end() {
    if (model_.paused()) {
      cycle(2.0);
      const JointSpace::Point before = bench_.out();
      cycle(ReferenceBench::kPeriod_s);
      check(same(before, bench_.out()), "a paused motion stands");
    }
    send(Ask::kResume);
    cycle(ReferenceBench::kPeriod_s);
    arrivals_expected_ = true;
    for (int k = 0; k < 50 && (model_.executing() || !model_.all_free()); ++k) cycle(0.05);
    cycle(2.0);
    check(!model_.executing(), "a trajectory that is resumed reaches its end");
    check(model_.all_free(), "every store comes back");
    for (int i = 0; i < asked_; ++i) check(reported_[at(i)].finals == 1, "one final report each");
    check_aim();
    for (int i = 0; i < kStores; ++i) {
      Trajectory<JointSpace>* motion = bench_.trajectory(kVelocityField | kAccelerationField);
      if (motion == nullptr) return check(false, "the client has every store again");
      bench_.add(*motion, 1.0, 0.0);
      std::uint32_t id = 0;
      check(bench_.client.send(*motion, id).ok(), "every store can be sent again");
    }
  }
  void check_aim() {
    const int aim = model_.aim(), canceled = model_.canceled();
    const double at_end = bench_.out().q[0] - bench_.home[0];
    if (aim < 0)
      return check(canceled < 0 || std::abs(at_end - goal(canceled)) > 1e-3,
                   "a cancelled trajectory is not finished");
    const bool to_point = sent_[at(aim)] == Ask::kPoint;
    const double offset = to_point ? 0.01 * (aim + 1) : goal(aim);
    check(std::abs(at_end - offset) <= 1e-12, "the motion ends where it was sent last");
    check(bench_.out().standing() == !(to_point && mode_ == OnlineMode::kForward),
          "the motion ends at rest");
  }

  OnlineMode mode_;
  ReferenceBench bench_;
  InterleavingModel model_;
  std::array<Fate, InterleavingModel::kMost> reported_{};
  std::array<std::uint32_t, InterleavingModel::kMost> ids_{};
  std::array<Ask, InterleavingModel::kMost> sent_{};
  std::array<int, InterleavingModel::kMost> stores_{};
  std::array<int, InterleavingModel::kMost> begins_{};  // the cycle of its start time
  int asked_ = 0, first_of_cycle_ = 0, cycles_ = 0;
  bool arrivals_expected_ = false;
  const char* complaint_ = nullptr;
};

}  // namespace tactus
