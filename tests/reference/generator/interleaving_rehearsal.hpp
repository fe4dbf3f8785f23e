// Rehearsal: plays one order of requests with a reference generator and with the model of its
// rules, and compares the two.
#pragma once

#include "tests/reference/generator/interleaving_client.hpp"
#include "tests/reference/motion/motion_oracle.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

/// One generator, its client, and the model of the expected outcomes.
class Rehearsal : private InterleavingClient {
 public:
  using InterleavingClient::InterleavingClient;

  /// Plays a case. Returns null, or the first thing that differs from the rules.
  const char* play(const Case& c) {
    begin();
    bring_to(c.begin);
    for (int k = 0, next = 0; k < kCycles; ++k) {
      while (next < c.count && c.cycles[at(next)] == k) send(c.asks[at(next++)]);
      cycle();
    }
    cycles(5);
    end();
    return complaint_;
  }
  /// True if the generator was in this phase after some cycle of some case.
  bool seen(MotionPhase phase) const { return seen_[static_cast<std::size_t>(phase)]; }

 private:
  /// Starts again at home. Requests that a former case left in the mailbox are refused and their
  /// stores returned.
  void begin() {
    forget();
    check(bench_.start(bench_.home) == Status::kOk, "the generator starts");
    check(bench_.step() == Status::kOk, "the first cycle");
    Report report;
    while (bench_.client.poll(report)) {
      check(report.outcome == Outcome::kRefused, "what came before the start is refused");
    }
    reported_.fill({});
    cycles_ = 1;
    refusing_ = false;
    oracle_.begin(bench_.channel.settings.limits, kPeriod_s, Smoothness::kAcceleration, kRateJerk);
  }
  void bring_to(Begin begin) {
    if (begin == Begin::kOnline) return;
    if (begin == Begin::kWaiting) {
      send(Ask::kLater, 6);
      return cycle();
    }
    const bool open = begin == Begin::kStreaming || begin == Begin::kStarving;
    send(open ? Ask::kOpen : Ask::kTrajectory);
    cycles(15);
    for (int k = 0; k < 100 && begin == Begin::kStarving && phase() != MotionPhase::kStarving; ++k)
      cycle();
    refusing_ = begin == Begin::kRefusing;
    if (refusing_) {
      model_.refuse_all();
      cycle();
    }
    if (begin < Begin::kBraking || begin > Begin::kPaused) return;
    send(begin == Begin::kBraking ? Ask::kCancel : Ask::kPause);
    cycles(begin == Begin::kPaused ? 30 : 2);
  }

  /// Returns the kind of a request when it is taken: a kLater trajectory whose start time has come
  /// is an ordinary one.
  Ask taken_as(int request) const {
    const bool late = sent_[at(request)] == Ask::kLater && cycles_ >= begins_[at(request)];
    return late ? Ask::kTrajectory : sent_[at(request)];
  }
  /// Takes all controls, then the other requests up to the first trajectory that begins or is
  /// refused, or up to the first that follows a point and is no point.
  void rehearse() {
    const bool due = model_.waiting() >= 0 && cycles_ >= begins_[at(model_.waiting())];
    model_.begin_cycle(due);
    bool alone = true, begun = due;
    for (int i = 0; i < asked_; ++i) alone = alone && (taken_[at(i)] || is_control(sent_[at(i)]));
    for (int i = 0; i < asked_; ++i) {
      if (!is_control(sent_[at(i)]) || taken_[at(i)]) continue;
      model_.control(sent_[at(i)], i, alone);
      taken_[at(i)] = true;
    }
    for (int i = 0; i < asked_ && !begun; ++i) {
      if (taken_[at(i)]) continue;
      const Ask ask = taken_as(i);
      const bool answered = refusing_ || (model_.voids(i) && !extends(ask));
      const bool behind = model_.point_taken() && ask != Ask::kPoint;
      model_.take(ask, i, stores_[at(i)]);
      taken_[at(i)] = true;
      begun = !answered && (behind || (carries_store(ask) && ask != Ask::kLater));
    }
  }
  void cycles(int count) {
    for (int k = 0; k < count; ++k) cycle();
  }
  void cycle() {
    const JointSpace::Point before = bench_.out();
    const int held = model_.held_point();
    if (refusing_) bench_.generator.brake(Status::kSlip, BrakeWay::kOnPath);
    check(bench_.step() == Status::kOk, "a cycle");
    ++cycles_;
    seen_[static_cast<std::size_t>(phase())] = true;
    std::array<Report, 16> reports;
    std::size_t count = 0;
    while (count < reports.size() && bench_.client.poll(reports[count])) {
      if (reports[count++].outcome == Outcome::kSucceeded) model_.arrive();
    }
    rehearse();
    for (std::size_t i = 0; i < count; ++i) take(reports[i]);
    check(model_.end_cycle(), "a store left behind comes back");
    check(model_.fates == reported_, "every request has the fate the rules say");
    check((bench_.generator.state() == ReferenceState::kTrajectoryExecution) == model_.executing(),
          "the state is that of the rules");
    check_output(before, held);
  }
  void take(const Report& report) {
    if (report.outcome == Outcome::kReleased)
      return check(report.id == 0 && report.verdict.ok() && model_.release(report.store),
                   "a store is released once");
    int request = 0;
    while (request < asked_ && ids_[at(request)] != report.id) ++request;
    if (request == asked_) return check(false, "a report has the id of its request");
    Fate& fate = reported_[at(request)];
    const Ask ask = sent_[at(request)];
    if (report.outcome == Outcome::kScheduled)
      return check(ask == Ask::kLater && fate == Fate(), "it waits for its time");
    if (report.outcome == Outcome::kStarved)
      return check(ask == Ask::kOpen && fate.started == 1, "it waits for more");
    if (report.outcome == Outcome::kStarted) {
      ++fate.started;
      return check(fate.finals == 0, "a start is reported before the end");
    }
    if (report.outcome == Outcome::kSucceeded)
      check(std::abs(bench_.out().q[0] - bench_.home.q[0] - ends_[at(request)]) < 1e-12,
            "it succeeds at its end");
    if (report.outcome == Outcome::kExecuted && extends(ask))
      ends_[at(feeds_[at(request)])] = ends_[at(request)];
    ++fate.finals;
    fate.outcome = report.outcome;
    fate.store = report.store;
    check(report.verdict.ok() != (report.outcome == Outcome::kRefused || refusing_),
          "a refusal says why");
  }

  /// A forwarded point may step. Otherwise nothing steps.
  void check_output(const JointSpace::Point& before, int held) {
    const JointSpace::Point& out = bench_.out();
    const bool forwards = mode_ == OnlineMode::kForward && model_.new_point() >= 0;
    const bool holds = mode_ == OnlineMode::kForward && held >= 0;
    if (forwards)
      check(same(out, point(model_.new_point())), "a point is forwarded as it came");
    else if (holds)
      check(same(out, before), "a point is held");
    if (forwards || holds) oracle_.forget();
    const Excess excess = oracle_.check(out);
    if (excess.what != nullptr && complaint_ == nullptr)
      print_error("%s of joint %d: %g, limit %g\n", excess.what, excess.track + 1, excess.value,
                  excess.limit);
    check(excess.what == nullptr, "nothing steps, and no limit is exceeded");
  }
  static bool same(const JointSpace::Point& a, const JointSpace::Point& b) {
    return a.q == b.q && a.dq == b.dq && a.ddq == b.ddq && a.tau == b.tau;
  }

  MotionPhase phase() const { return bench_.generator.phase(); }
  /// True if the reference is at rest, or a forwarded point is held, which may have a velocity.
  bool rests() const {
    return bench_.out().standing() || (mode_ == OnlineMode::kForward && model_.held_point() >= 0);
  }
  void come_to_rest() {
    for (int k = 0; k < 100 && !rests(); ++k) cycle();
  }

  /// Ends a case: a paused motion stays at rest and alive; resumed, and closed if it is open, it
  /// ends and every store comes back.
  void end() {
    if (model_.paused()) {
      come_to_rest();
      const JointSpace::Point before = bench_.out();
      cycle();
      check(same(before, bench_.out()), "a paused motion stands");
    }
    send(Ask::kResume);
    if (model_.open()) send(Ask::kLast);
    cycle();
    for (int k = 0; k < 200 && (model_.executing() || !model_.all_free()); ++k) cycle();
    come_to_rest();
    check(!model_.executing(), "a trajectory that is resumed reaches its end");
    check(model_.all_free(), "every store comes back");
    for (int i = 0; i < asked_; ++i) check(reported_[at(i)].finals == 1, "one final report each");
    check_aim();
    send_every_store();
  }
  void check_aim() {
    const int aim = model_.aim(), canceled = model_.canceled();
    const double at_end = bench_.out().q[0] - bench_.home.q[0];
    if (aim < 0)
      return check(canceled < 0 || sent_[at(canceled)] == Ask::kOpen ||
                       std::abs(at_end - goal(canceled)) > 1e-3,
                   "a cancelled trajectory is not finished");
    const bool to_point = sent_[at(aim)] == Ask::kPoint;
    const double offset = to_point ? 0.002 * (aim + 1) : ends_[at(aim)];
    check(std::abs(at_end - offset) <= 1e-12, "the motion ends where it was sent last");
    check(bench_.out().standing() == !(to_point && mode_ == OnlineMode::kForward),
          "the motion ends at rest");
  }
  void send_every_store() {
    for (int i = 0; i < kStores; ++i) {
      Trajectory<JointSpace>* motion = bench_.trajectory(kVelocityField | kAccelerationField);
      if (motion == nullptr) return check(false, "the client has every store again");
      motion->open = false;
      bench_.add(*motion, 1.0, 0.0);
      std::uint32_t id = 0;
      check(bench_.client.send(*motion, id).ok(), "every store can be sent again");
    }
  }

  MotionOracle<JointSpace> oracle_;
  PerRequest<Fate> reported_{};
  std::array<bool, kPhases> seen_{};
  bool refusing_ = false;
};

}  // namespace tactus
