// The points of a trajectory of external control: moves and splines.
#pragma once

#include "sim_plant/ur/motion/motion.hpp"
#include "sim_plant/ur/parts/machine.hpp"

namespace tactus::ur {

// The points of a trajectory that are moves.

/// A point as it comes over the wire.
using TrajectoryPoint = std::array<std::int32_t, kTrajectoryInts>;
/// Returns six numbers from `first` on, which are integers of 1 / `scale`.
Vector6 six_numbers(const TrajectoryPoint& point, std::size_t first, double scale = kFixedPoint);

/// How a text reads a point, which differs between releases of the client library: the places of a
/// move's speed and acceleration among its integers, and the units of time, blend radius, and
/// speeds and accelerations of a spline.
struct PointFormat {
  struct Places {
    std::size_t v = 12, a = 13;
  };
  Places moves, circles;
  double time_scale = kFixedPoint, rate_scale = kFixedPoint;
};
PointFormat find_point_format(std::string_view text);

/// True for a move that this generation of controllers has.
bool is_move(std::int32_t type);

/// Reads the move of a point. False: no posture reaches its pose.
bool read_move(const TrajectoryPoint& point, const PointFormat& format, const Machine& machine,
               Move& move);

/// True for a move that this generation of controllers does not have; texts show a popup instead.
bool is_optimove(std::int32_t type);

/// SplineRun: one segment of a joint trajectory, interpolated as in the vendor's script: every step
/// passes the derivative of the polynomial to speedj. If the last point would be reached with
/// speed, the time is slowed so that 15 rad/s^2 are enough to stop on the path.
class SplineRun {
 public:
  /// Starts with the speeds and accelerations at the end of the last segment. `quintic`: `ddq_end`
  /// is used. `duration_s` > 0.
  void start(const Joints& q, const Joints& q_end, const Joints& dq_end, const Joints& ddq_end,
             double duration_s, bool quintic, bool last);
  /// Makes the next segment start from rest.
  void forget() { dq_ = ddq_ = Joints::Zero(); }
  void forget_acceleration() { ddq_ = Joints::Zero(); }

  /// Gives the next speedj, for one cycle. False: the segment has ended.
  bool command(Motion& motion, double cycle_s);
  double travelled_s() const { return time_s_; }

 private:
  enum class Phase : std::uint8_t { kSteps, kSlowing, kLast, kDone };

  Joints speed(double t) const;
  Joints acceleration(double t) const;
  bool too_fast_to_stop(double left_s, double cycle_s) const;
  void step(double to_s, double step_s, Motion& motion);

  std::array<Joints, 6> c_{};  // coefficients of the powers of time
  Joints dq_ = Joints::Zero(), ddq_ = Joints::Zero();
  double duration_s_ = 0.0, time_s_ = 0.0;
  double scale_ = 1.0, slowing_s_ = 0.0;
  bool last_ = false, slowing_ = false;
  Phase phase_ = Phase::kDone;
};

}  // namespace tactus::ur
