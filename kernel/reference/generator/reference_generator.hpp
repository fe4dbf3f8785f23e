// ReferenceGenerator: the paper's reference generator, for every space. It takes controls and
// requests from its channel, gives its motion the trajectory or the point to follow, and answers
// each with exactly one final report.
//
// Its state is the phase of its motion (motion_phase.hpp), a trajectory that may wait for its start
// time, and the reason for which it refuses everything while the executive brakes. On a board with
// streams, kernel/streams completes it: requests of streams, and what they leave behind. Its
// functions are in reference_generator_members.hpp, those of controls and requests in
// reference_requests_members.hpp.
#pragma once

#include "kernel/core/brake.hpp"
#include "kernel/core/digital_outputs.hpp"
#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/generator/feedback.hpp"
#include "kernel/reference/generator/messages.hpp"
#include "kernel/reference/generator/tolerance_monitor.hpp"
#include "kernel/reference/motion/motion.hpp"

namespace tactus {

/// Treatment of online points.
enum class OnlineMode : std::uint8_t {
  kForward,  ///< the point becomes the reference as it is
  kLimit,    ///< the reference goes to it within velocity, acceleration and jerk limits
  kRefuse,   ///< as kForward, but a step beyond the velocity limits is refused: judge_step()
};

constexpr const char* name(OnlineMode online) {
  switch (online) {
    case OnlineMode::kForward: return "forward";
    case OnlineMode::kLimit: return "limit";
    case OnlineMode::kRefuse: return "refuse";
  }
  return nullptr;
}

/// Bounds of points in addition to the limits.
struct PointBounds {
  double max_step = 0.0;  ///< largest distance from the reference: rad, of a tip m and rad; 0: any
  /// Largest velocity on the way to points or chunks of a new motion: rad/s, of a tip m/s and
  /// rad/s; 0: the limit.
  double approach_speed = 0.0;
};

/// Motion state that a generator of any space reports.
struct MotionState {
  double time_s = 0.0;  ///< generator time: periods since start
  MotionPhase phase = MotionPhase::kHolding;
  double override = 1.0;  ///< rate of trajectories, 0..1, without the robot's speed scaling
};

// Defined in kernel/streams.
template <class Space>
struct StreamAccount;

template <class Space>
class ReferenceGenerator {
 public:
  using Point = typename Space::Point;

  struct Params {
    /// Largest distance from the reference to a trajectory whose first waypoint is at t = 0.
    typename Space::Tolerance start_tolerance;
    Tolerances<Space> tolerances;  ///< for goals that give none of their own
    int latency_cycles = 0;        ///< 0..16; 0: measured in the next cycle
    OnlineMode online = OnlineMode::kForward;
    OnlyWithStreams<PointBounds> bounds{};
    /// Longest time without a new point after which a moving online reference is stopped; 0: none.
    double timeout_s = 0.0;
    int feedback_divisor = 0;  ///< cycles between two messages of feedback; 0: none
    Fields measured = 0;       ///< fields that step() is given besides the position
  };

  /// Holds `measured` until the next request. Aborts what ran and refuses what was sent before, as
  /// old targets are void after a start. kStateNotFinite if `measured` is not finite. [init]
  [[gnu::cold]] Status start(ReferenceChannel<Space>& channel, const Params& params,
                             const Point& measured);

  /// Moves the reference one period ahead, compares it with the measured point, answers controls
  /// and requests, publishes feedback. kReferenceFault if the reference is not finite,
  /// kPathTolerance if the robot is not where a reference without a goal has long rested. [cyclic]
  Status step(double dt_s, const Point& measured);

  /// Sets the speed scaling of the robot, 0 at rest and 1 as sent. Trajectories pass at this times
  /// the override from now on, so that they wait for the robot instead of running ahead of it.
  /// Clamps to 0..1; NaN counts as 0. Must be called before step(). [cyclic]
  void scale_speed(double scaling);

  /// How the robot follows a reference without a goal, as the last step() has judged it:
  /// kPathTolerance with axis, value and limit, or kOk. [between two cycles]
  Verdict held() const { return running_.any() ? Verdict() : monitor_.follows(measured_); }

  /// The executive brakes for the reason `why`. Aborts the running and the waiting trajectory,
  /// brings the reference to rest within limits, on its path or at once, and refuses requests with
  /// `why` until the next start. Must be called in every cycle in which they are refused. [cyclic]
  void brake(Status why, BrakeWay way);
  /// Lets brake() refuse the requests of a channel before the first start. [cyclic]
  void attach(ReferenceChannel<Space>& channel) { channel_ = &channel; }

  const Point& reference() const { return motion_.reference(); }
  MotionPhase phase() const { return motion_.phase(); }
  ReferenceState state() const { return state_of(phase()); }
  /// Generator time: periods since start, s.
  double time_s() const { return time_s_; }
  MotionState motion_state() const { return {time_s_, phase(), override_}; }
  /// Digital outputs as chunks and points have set them; none on a board without streams.
  DigitalOutputs outputs() const {
    if constexpr (kStreams) return stream_.outputs.active();
    return {};
  }

 private:
  /// A trajectory that was accepted: the number of its request, and its store; -1: none.
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
  Verdict answer(const Control& control, LoopBound<2>& cancels);
  Verdict cancel(std::uint32_t id, LoopBound<2>& cancels);
  Verdict set_override(double rate);
  void take_requests();
  bool answered(const Request<Space>& request);
  bool canceled(const Request<Space>& request);
  void refuse(const Request<Space>& request, Status why);
  Verdict judge_point(const Point& point) const;
  Verdict judge_step(const Point& point, bool& forwards);
  bool note_saturation(const Verdict& verdict);
  void take_point(const Request<Space>& request);
  void take_trajectory(const Request<Space>& request);
  void take_append(const Request<Space>& request);
  void take_other(const Request<Space>& request);
  void take_stream(const Request<Space>& request);
  void take_chunk(const Request<Space>& request);
  Verdict judge_targets(const ChunkCurve<Space>& chunk, Verdict& saturation) const;
  void take_velocity(const Request<Space>& request);
  bool in_order(const Request<Space>& request, std::uint32_t epoch, std::uint32_t sequence);
  void end_epoch();
  bool outputs_wait() const {
    if constexpr (kStreams) return stream_.outputs.waits();
    return false;
  }
  void void_request(const Request<Space>& request);
  void begin_stream(std::uint32_t id, const Verdict& saturation = {});
  void pass_outputs();
  void watch_expiry();
  void watch_supply();
  void watch_goal(double dt_s, const Point& measured);
  void watch_stream(double dt_s);
  void watch_start();
  bool begin(const Goal& goal, double elapsed_s);
  void end_waiting(Outcome outcome, const Verdict& verdict = {});
  void end_running(Outcome outcome, bool path_left, const Verdict& verdict = {});
  void release_store();
  void report(std::uint32_t id, Outcome outcome, int store = -1, const Verdict& verdict = {});

  ReferenceChannel<Space>* channel_ = nullptr;
  Params params_;
  std::size_t void_requests_ = 0, void_controls_ = 0;  // sent before the start, to be refused
  Status refusing_ = Status::kOk;                      // the reason while the executive brakes

  double period_s_ = 0.0;
  std::int64_t cycles_ = 0;
  double time_s_ = 0.0;
  Point measured_;  // in this cycle
  Motion<Space> motion_;
  ToleranceMonitor<Space> monitor_;
  FeedbackPublisher<Space> feedback_;
  double override_ = 1.0, speed_scaling_ = 1.0;

  Goal running_;           // being executed
  Goal waiting_;           // for its start time
  int braked_on_ = -1;     // store of a trajectory that was given up but is still read
  bool starving_ = false;  // and reported to the client
  /// A trajectory has begun in this cycle. Judging the way to it takes longest, so further requests
  /// wait for the next cycle.
  bool begun_ = false;
  std::uint32_t canceled_before_ = 0;  // number of the last cancel

  double point_age_s_ = -kInfinity;  // since the last online point; -infinity: no point to watch

  OnlyWithStreams<StreamAccount<Space>> stream_;
};

}  // namespace tactus
