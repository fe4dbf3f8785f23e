// ReferenceGenerator: the paper's reference generator, once for every space. Takes controls and
// requests from its channel, tells its motion what to follow, and accounts for every one of them in
// exactly one final report.
//
// What the generator is doing is the phase of its motion (motion_phase.hpp); beside it there may be
// a trajectory that waits for its start time, and the reason for which the executive has everything
// refused.
#pragma once

#include "kernel/brake.hpp"
#include "kernel/reference/motion.hpp"
#include "kernel/reference/tolerance_monitor.hpp"

namespace tactus {

/// What is done with an online point.
enum class OnlineMode : std::uint8_t {
  kForward,  ///< put out as it came
  kLimit,    ///< gone to, or along with, within velocity, acceleration and jerk limits
  kRefuse,   ///< put out as it came, but refused if that takes more than the velocity limits
};

inline constexpr std::array<const char*, 3> kOnlineModeWords = {"forward", "limit", "refuse"};

template <class Space>
class ReferenceGenerator {
 public:
  using Point = typename Space::Point;

  struct Params {
    /// How far beside the reference a trajectory may begin whose first waypoint is at t = 0.
    typename Space::Tolerance start_tolerance;
    Tolerances<Space> tolerances;  ///< of goals that give none of their own
    int latency_cycles = 0;        ///< 0..16; 0: measured in the next cycle
    OnlineMode online = OnlineMode::kForward;
    /// Without a new point for so long, an online reference that moves is stopped; 0: never.
    double timeout_s = 0.0;
    int feedback_divisor = 0;  ///< cycles between two messages of feedback; 0: none
    Fields measured = 0;       ///< what step() is given beside the position
  };

  /// Holds `measured` until told otherwise. What ran before is aborted, and what was sent before is
  /// refused: after a start old targets are void. kStateNotFinite if `measured` is not finite.
  /// [init]
  Status start(ReferenceChannel<Space>& channel, const Params& params, const Point& measured);

  /// Moves on by one period, compares with what was measured, answers controls and requests,
  /// publishes feedback. kReferenceFault if the reference is not finite. [cyclic]
  Status step(double dt_s, const Point& measured);

  /// How fast the robot lets motions pass, 0 standing, 1 as sent: trajectories pass at that times
  /// the override from now on, so that they wait for the robot instead of running ahead of it. What
  /// is outside 0..1 or not a number counts as the nearest, and as 0. Before step(). [cyclic]
  void scale_speed(double scaling);

  /// The executive brakes, for the reason `why`: what runs and what waits is aborted, the reference
  /// comes to rest within limits, on its path or at once; requests are refused with `why` from now
  /// on, in this cycle too, until the next start. To be called in every cycle in which they are.
  /// [cyclic]
  void brake(Status why, BrakeWay way);

  const Point& reference() const { return motion_.reference(); }
  Phase phase() const { return motion_.phase(); }
  ReferenceState state() const { return state_of(phase()); }
  /// The generator's time: periods since start, s.
  double time_s() const { return static_cast<double>(cycles_) * period_s_; }

 private:
  /// A trajectory that was accepted: its request and its store, -1: none.
  struct Goal {
    std::uint32_t id = 0;
    int store = -1;
    bool any() const { return store >= 0; }
  };

  Trajectory<Space>& trajectory(const Goal& goal) const {
    return channel_->stores[static_cast<std::size_t>(goal.store)];
  }
  bool has_room() const;
  void take_controls();
  Verdict answer(const Control& control);
  Verdict cancel(std::uint32_t id);
  Verdict set_override(double rate);
  void take_requests();
  void answer(const Request<Space>& request);
  bool canceled(const Request<Space>& request);
  void refuse(const Request<Space>& request, Status why);
  Verdict judge_point(const Point& point) const;
  void take_point(const Request<Space>& request);
  void take_trajectory(const Request<Space>& request);
  void take_append(const Request<Space>& request);
  void watch_supply();
  void watch_goal(double dt_s, const Point& measured);
  void watch_stream(double dt_s);
  void watch_start();
  bool begin(const Goal& goal, double elapsed_s);
  void end_waiting(Outcome outcome, const Verdict& verdict = {});
  void end_running(Outcome outcome, bool path_left, const Verdict& verdict = {});
  void release_store();
  void settle_point(Outcome outcome);
  void report(std::uint32_t id, Outcome outcome, int store = -1, const Verdict& verdict = {});

  ReferenceChannel<Space>* channel_ = nullptr;
  Params params_;
  std::size_t void_requests_ = 0, void_controls_ = 0;  // sent before the start, to be refused
  Status refusing_ = Status::kOk;                      // while the executive brakes: why

  double period_s_ = 0.0;
  std::int64_t cycles_ = 0;
  Point measured_;  // in this cycle
  Motion<Space> motion_;
  ToleranceMonitor<Space> monitor_;
  FeedbackPublisher<Space> feedback_;
  double override_ = 1.0, speed_scaling_ = 1.0;

  Goal running_;           // being executed
  Goal waiting_;           // for its start time
  int braked_on_ = -1;     // store of one that was given up, and which the motion still reads
  bool starving_ = false;  // and the client has been told
  /// In this cycle a trajectory has begun, the way to which takes longest of all to judge: what
  /// else was requested waits for the next.
  bool begun_ = false;
  std::uint32_t canceled_before_ = 0;  // number of the last cancel

  double point_age_s_ = -kInfinity;  // since the last online point; -infinity: none is watched
  bool point_pending_ = false;       // a point was taken in this cycle and is not yet put out
  std::uint32_t point_id_ = 0;
};

}  // namespace tactus
