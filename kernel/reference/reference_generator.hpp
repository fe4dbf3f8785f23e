// ReferenceGenerator: the paper's reference generator, once for every space. Takes points,
// trajectories and cancels from its channel, and gives one reference per cycle.
//
// The reference is the sum of two motions: the base, which is the running trajectory or a point
// that is held, and the bridge, a quintic that carries the difference between where the reference
// was and where the base begins down to zero. So a replaced or cancelled trajectory ends without a
// step in position, velocity or acceleration.
#pragma once

#include "kernel/reference/admission.hpp"
#include "kernel/reference/messages.hpp"
#include "kernel/reference/reference_state.hpp"

namespace tactus {

template <class Space>
class ReferenceGenerator {
 public:
  using Point = typename Space::Point;
  using Segment = typename Space::Segment;

  /// Holds `measured` until told otherwise. What ran before is aborted, and requests that came
  /// before are refused: after a start old targets are void. A trajectory whose first waypoint is
  /// at t = 0 must begin within `start_tolerance` (rad) of the reference. kStateNotFinite if
  /// `measured` is not finite. [init]
  Status start(ReferenceChannel<Space>& channel, const JointVector& start_tolerance,
               const Point& measured);

  /// Moves on by one period, then answers requests. kReferenceFault if the reference is not finite.
  /// [cyclic]
  Status step(double dt_s);

  const Point& reference() const { return reference_; }
  ReferenceState state() const { return state_; }

 private:
  /// A trajectory being executed and the place reached on it.
  struct Execution {
    const Trajectory<Space>* trajectory = nullptr;
    std::uint32_t id = 0;
    int store = -1;
    int target = 0;       // waypoint at which the present segment ends
    double time_s = 0.0;  // since the trajectory began
    double segment_start_s = 0.0;
    Segment segment;
  };

  bool executing() const { return state_ == ReferenceState::kTrajectoryExecution; }
  void move_on(double dt_s);
  Point base();
  void answer(const Request<Space>& request);
  void take_point(const Request<Space>& request);
  void take_trajectory(const Request<Space>& request);
  void take_cancel(const Request<Space>& request);
  Verdict prepare(const Request<Space>& request, Execution& execution) const;
  void end_execution(ReferenceEvent event, Outcome outcome);
  void bridge_to(const Point& base, double duration_s);
  void settle_point(Outcome outcome);
  void report(std::uint32_t id, Outcome outcome, int store = -1, const Verdict& verdict = {});

  ReferenceChannel<Space>* channel_ = nullptr;
  JointVector start_tolerance_ = JointVector::Zero();

  ReferenceState state_ = ReferenceState::kOnlineReference;
  Point reference_;      // put out in this cycle
  Point held_;           // the base while online
  Execution execution_;  // the base while executing

  Segment bridge_;
  double bridge_time_s_ = 0.0;
  bool bridging_ = false;

  std::size_t void_requests_ = 0;  // that came before the start and are still to be refused

  bool point_pending_ = false;  // a point was taken in this cycle and is not yet put out
  std::uint32_t point_id_ = 0;
};

}  // namespace tactus
