// The requests of an interleaving: points and trajectories small enough to keep tight limits from
// any state of the reference, each with an end of its own by which it is recognized.
#pragma once

#include "tests/reference/generator/interleaving_case.hpp"
#include "tests/reference/generator/reference_bench.hpp"

namespace tactus {

/// The client's part of a case: sends requests and keeps a record of them.
class InterleavingClient {
 public:
  static constexpr double kPeriod_s = 8e-3;

  /// Limits are tight, so that a step of a fraction of an acceleration exceeds the jerk limit.
  explicit InterleavingClient(OnlineMode mode) : mode_(mode) {
    bench_.params.online = mode;
    bench_.params.tolerances.dwell_s = 2.0 * kPeriod_s;
    bench_.period_s = bench_.channel.settings.period_s = kPeriod_s;
    bench_.channel.settings.limits.ddq_max.setConstant(5.0);
    bench_.channel.settings.limits.dddq_max.setConstant(250.0);
  }

 protected:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  void check(bool holds, const char* complaint) {
    if (!holds && complaint_ == nullptr) complaint_ = complaint;
  }
  void forget() {
    complaint_ = nullptr;
    model_ = InterleavingModel();
    taken_.fill(false);
    asked_ = 0;
    stream_ = -1;
  }

  /// Returns a point at the distance `way` from home with the velocity `speed`; the first joint has
  /// the largest share.
  JointSpace::Point beside_home(double way, double speed) const {
    JointVector direction = JointVector::Constant(0.4);
    direction[0] = 1.0;
    JointSpace::Point point;
    point.q = bench_.home.q + way * direction;
    point.dq = speed * direction;
    return point;
  }
  /// A forwarded point keeps its velocity; a point under kLimit has none, as it must be a place and
  /// not a stream that gives velocities.
  JointSpace::Point point(int request) const {
    return beside_home(0.002 * (request + 1), mode_ == OnlineMode::kForward ? 0.03 : 0.0);
  }
  static double goal(int request) { return 0.01 + 0.002 * request; }

  Verdict send_trajectory(Ask ask, int ahead, std::uint32_t& id, int& store) {
    Trajectory<JointSpace>* motion = bench_.trajectory(kVelocityField | kAccelerationField);
    check((motion != nullptr) == model_.any_free(),
          "a store is to be had if and only if one is free");
    if (motion == nullptr) return {Status::kNoFreeStore};
    store = static_cast<int>(motion - bench_.channel.stores.data());
    check(model_.free(store), "the store acquired was free");
    if (ask == Ask::kTooFast) {
      bench_.add(*motion, 0.05, 0.5);
    } else {
      motion->waypoints[0] = {0.2, beside_home(0.5 * goal(asked_), 0.03)};
      motion->waypoints[1] = {0.4, beside_home(goal(asked_), 0.0)};
      motion->count = 2;
    }
    motion->open = ask == Ask::kOpen;
    if (ask == Ask::kLater) motion->start_s = (cycles_ + ahead) * kPeriod_s;
    ends_[at(asked_)] = goal(asked_);
    if (stream_ >= 0 && stores_[at(stream_)] == store) stream_ = -1;
    if (ask == Ask::kOpen) {
      stream_ = asked_;
      stream_end_ = goal(asked_);
      stream_end_s_ = 0.4;
    }
    model_.send(store, motion->open);
    return bench_.client.send(*motion, id);
  }
  /// Sends one more waypoint of the last open trajectory, if it still has its store.
  Verdict send_more(Ask ask, std::uint32_t& id, int& store) {
    if (stream_ < 0) return {Status::kNoFreeStore};
    store = stores_[at(stream_)];
    const Trajectory<JointSpace>& motion = bench_.channel.stores[at(store)];
    const Waypoint<JointSpace> waypoint = {stream_end_s_ + 0.1,
                                           beside_home(stream_end_ + 0.003, 0.0)};
    const Verdict verdict = bench_.client.append(motion, waypoint);
    const bool gone = verdict.status == Status::kNothingToExtend;
    check(gone == model_.free(store), "what has its store back cannot become longer");
    if (gone) return {Status::kNoFreeStore};
    stream_end_s_ += 0.1;
    ends_[at(asked_)] = stream_end_ += 0.003;
    feeds_[at(asked_)] = stream_;
    return verdict.ok() ? bench_.client.flush(motion, ask == Ask::kLast, id) : verdict;
  }
  Verdict send(Ask ask, int ahead, std::uint32_t& id, int& store) {
    if (carries_store(ask)) return send_trajectory(ask, ahead, id, store);
    if (extends(ask)) return send_more(ask, id, store);
    if (ask == Ask::kPoint) return bench_.client.send(point(asked_), id);
    if (ask == Ask::kCancel) return bench_.client.cancel(id);
    if (ask == Ask::kHalf) return bench_.client.set_override(0.5, id);
    return ask == Ask::kPause ? bench_.client.pause(id) : bench_.client.resume(id);
  }
  /// `ahead`: cycles until the start of a kLater trajectory.
  void send(Ask ask, int ahead = 2) {
    std::uint32_t id = 0;
    int store = -1;
    const Verdict verdict = send(ask, ahead, id, store);
    if (verdict.status == Status::kNoFreeStore) return;
    check(verdict.ok(), "the client sends what it may");
    ids_[at(asked_)] = id;
    sent_[at(asked_)] = ask;
    begins_[at(asked_)] = cycles_ + ahead;
    stores_[at(asked_)] = store;
    ++asked_;
  }

  OnlineMode mode_;
  ReferenceBench bench_;
  InterleavingModel model_;
  template <class T>
  using PerRequest = std::array<T, InterleavingModel::kMost>;
  int asked_ = 0, cycles_ = 0;  // requests and cycles since the start
  PerRequest<Ask> sent_{};
  PerRequest<std::uint32_t> ids_{};
  PerRequest<bool> taken_{};
  PerRequest<int> stores_{}, begins_{}, feeds_{};  // store; cycle of its start; what it extends
  PerRequest<double> ends_{};                      // end of a trajectory, or of a part of it
  const char* complaint_ = nullptr;

 private:
  int stream_ = -1;  // request of the last open trajectory
  double stream_end_ = 0.0, stream_end_s_ = 0.0;
};

}  // namespace tactus
