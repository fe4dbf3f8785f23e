// SplineRun: one segment of a joint trajectory, interpolated as in the vendor's script: every step
// passes the derivative of the polynomial to speedj. If the last point would be reached with speed,
// the time is slowed so that 15 rad/s^2 are enough to stop on the path.
#pragma once

#include "sim_plant/ur/motion/motion.hpp"

namespace tactus::ur {

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
