// ReferenceGenerator: the paper's reference generator, once for every space. Takes requests from
// its channel, tells its motion what to follow, and accounts for every request in exactly one final
// report.
#pragma once

#include "kernel/brake.hpp"
#include "kernel/reference/motion.hpp"
#include "kernel/reference/reference_state.hpp"
#include "kernel/reference/tolerance_monitor.hpp"

namespace tactus {

/// What is done with an online point.
enum class OnlineMode : std::uint8_t {
  kForward,  ///< put out as it came
  kLimit,    ///< gone to within velocity, acceleration and jerk limits
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
    Fields measured = 0;       ///< what step() is given beside the position, for feedback
  };

  /// Holds `measured` until told otherwise. What ran before is aborted, and requests that came
  /// before are refused: after a start old targets are void. kStateNotFinite if `measured` is not
  /// finite. [init]
  Status start(ReferenceChannel<Space>& channel, const Params& params, const Point& measured);

  /// Moves on by one period, compares with what was measured, answers requests, publishes feedback.
  /// kReferenceFault if the reference is not finite. [cyclic]
  Status step(double dt_s, const Point& measured);

  /// How fast the robot lets motions pass, 0 standing, 1 as sent: trajectories pass at that times
  /// the override from now on, so that they wait for the robot instead of running ahead of it. What
  /// is outside 0..1 or not a number counts as the nearest, and as 0. Before step(). [cyclic]
  void scale_speed(double scaling);

  /// The executive brakes, for the reason `why`: what runs and what waits is aborted, the reference
  /// comes to rest on its path, within limits; requests are refused with `why` from now on, in this
  /// cycle too, until the next start. To be called in every cycle in which they are. [cyclic]
  void brake(Status why, BrakeWay way);

  const Point& reference() const { return motion_.reference(); }
  ReferenceState state() const { return state_; }
  /// The generator's time: periods since start, s.
  double time_s() const { return static_cast<double>(cycles_) * period_s_; }

 private:
  /// A trajectory that was accepted: its request and its store, -1: none.
  struct Goal {
    std::uint32_t id = 0;
    int store = -1;
  };

  double rate() const { return paused_ ? 0.0 : override_ * speed_scaling_; }
  bool executing() const { return state_ == ReferenceState::kTrajectoryExecution; }
  void take_requests();
  void refuse(const Request<Space>& request, Status why);
  void stand();
  void answer(const Request<Space>& request);
  Verdict judge_point(const Point& point) const;
  void take_point(const Request<Space>& request);
  void take_trajectory(const Request<Space>& request);
  void take_cancel(const Request<Space>& request);
  void take_override(const Request<Space>& request);
  void take_pause(const Request<Space>& request);
  void take_append(const Request<Space>& request);
  void watch_supply();
  void watch_goal(double dt_s, const Point& measured);
  void watch_stream(double dt_s);
  void watch_start();
  Verdict shape(const Point& point);
  bool begin(const Goal& goal, double elapsed_s);
  void end_waiting(Outcome outcome, const Verdict& verdict = {});
  void end_execution(ReferenceEvent event, Outcome outcome, bool path_left,
                     const Verdict& verdict = {});
  void release_store();
  void settle_point(Outcome outcome);
  void report(std::uint32_t id, Outcome outcome, int store = -1, const Verdict& verdict = {});

  ReferenceChannel<Space>* channel_ = nullptr;
  Params params_;
  std::size_t void_requests_ = 0;  // that came before the start and are still to be refused
  Status refusing_ = Status::kOk;  // while the executive brakes: why

  double period_s_ = 0.0;
  std::int64_t cycles_ = 0;
  ReferenceState state_ = ReferenceState::kOnlineReference;
  Motion<Space> motion_;
  ToleranceMonitor<Space> monitor_;
  FeedbackPublisher<Space> feedback_;
  double override_ = 1.0, speed_scaling_ = 1.0;
  bool paused_ = false;

  Goal running_;           // executed, or braked on: the motion still reads its store
  Goal waiting_;           // for its start time
  bool starving_ = false;  // and the client has been told

  /// In this cycle the way to a trajectory or to rest has been judged against the limits, which
  /// takes longest of all: once in a cycle, and what else is asked for waits for the next.
  bool planned_ = false;

  double point_age_s_ = 0.0;    // since the last online point
  bool point_pending_ = false;  // a point was taken in this cycle and is not yet put out
  std::uint32_t point_id_ = 0;
};

}  // namespace tactus
