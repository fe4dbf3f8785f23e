// The set-point generator of the controller, and the law of servoj.
#pragma once

#include <limits>

#include "sim_plant/ur/motion/force_mode.hpp"
#include "sim_plant/ur/motion/move_path.hpp"
#include "sim_plant/ur/motion/safety_limits.hpp"

namespace tactus::ur {

/// The law of servoj: the gain g pulls the target position, projected over the lookahead time L
/// with the present target speed, towards the set-point c,
///
///   ddq = g (c - q - L dq)
///
/// as the script manual describes it. This is a system of second order with the natural frequency
/// sqrt(g) and the damping ratio L sqrt(g) / 2; it follows a ramp late by L. The solution is exact
/// in every period, so a slower time base does not change the path.
struct ServoLaw {
  double gain = 300.0;       ///< 1/s^2
  double lookahead_s = 0.1;  ///< s

  /// Moves one joint for `h_s` towards a constant set-point; updates position and speed.
  void step(double set_point, double h_s, double& q, double& dq) const;
};

inline constexpr double kNothing_s = 1e-9;  ///< a shorter time counts as zero

/// Motion: the set-point generator of the controller. A script gives it one command at a time; it
/// moves the joint targets from cycle to cycle, by a time base that the speed slider stretches.
///
///   movej, movel,  a trapezoid of speed from rest to rest, on the leading axis or on the line;
///   with movep, movec   a blend radius the arm goes on to the next move without stopping
///   (MovePath) servoj         ServoLaw, for t seconds speedj, speedl a linear change of speed, for
///   t seconds or until it is reached; then it is held stopj          a linear change to rest
///
/// Force mode displaces the tool in addition; in freedrive the targets follow the
/// arm.
///
/// A target that cannot be followed is a fault and causes a protective stop.
class Motion {
 public:
  explicit Motion(const MotionLimits& limits = {}, const ForceSettings& force = {})
      : limits_(limits), path_(limits_), force_law_(force) {}
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  /// Rests at `q` and forgets every command. [any]
  void rest(const Joints& q);
  /// Sets the tip in the flange, for the commands in tool space. [any]
  void set_tool(const Frame& tool) { tool_ = tool; }
  const Frame& tool() const { return tool_; }

  /// The commands of a script. A speed, acceleration or time that is not positive takes the default
  /// of the script manual. False: the target cannot be reached, and nothing moves.
  bool move(const Move& move);
  bool move_j(const Joints& q, double a, double v, double t, double r = 0.0);
  bool move_l(const Frame& target, double a, double v, double t, double r = 0.0);
  void servo_j(const Joints& q, double t, const ServoLaw& law);
  void speed_j(const Joints& dq, double a, double t);
  void speed_l(const Vector6& twist, double a, double t);
  void stop_j(double a);

  /// Ends the wait for the last command, whose program has ended; the arm goes on moving.
  void abandon() { busy_ = false; }

  /// True if a command of the script has not returned. [any]
  bool busy() const { return busy_; }
  /// True if the speed is zero and no command would change it. [any]
  bool resting() const { return dq_.isZero(0.0) && !busy_ && kind_ != Kind::kMove; }
  /// True if the last move returned because of its blend radius and no other has come: the arm goes
  /// on to its waypoint. [any]
  bool arriving() const { return kind_ == Kind::kMove && !busy_; }

  /// Moves for at most `h_s` of the stretched time base; returns the time that the command took.
  /// [cyclic]
  double advance(double h_s);
  /// Moves for `h_s` without a command. `playing`: a script runs; otherwise the arm comes to rest.
  /// [cyclic]
  void idle(double h_s, bool playing);
  /// Runs force mode for `h_s` with the wrench on the tip, base frame. After the end of force mode
  /// the tool comes to rest. [cyclic]
  void yield(const ForceMode& mode, double damping, const Vector6& force, double h_s);
  /// Follows a hand that moves the arm; commands are ignored. When the hand lets go, the arm
  /// brakes. [cyclic]
  void carry(const Joints& q, const Joints& dq);
  /// Brakes for a protective stop; commands are ignored until the arm is at rest. [cyclic]
  void brake(double h_s);

  /// Returns why the last step could not be made, or kNone, and clears it. [cyclic]
  Stop take_fault();
  /// Returns true if blend radii overlapped and one was left out, and clears it. [cyclic]
  bool take_overlap() { return path_.take_overlap(); }

  Joints q() const { return q_ + offset_; }       ///< the targets, rad
  Joints dq() const { return dq_ + offset_dq_; }  ///< their speed in stretched time, rad/s
  const Matrix3& task_axes() const { return force_law_.axes(); }
  const MotionLimits& limits() const { return limits_; }

 private:
  static constexpr double kForever = std::numeric_limits<double>::infinity();
  enum class Kind : std::uint8_t {
    kRest,
    kMove,
    kServo,
    kSpeedJ,
    kSpeedL,
    kStop,
    kBrakeFirst,
    kCarried,  // by a hand
  };
  void begin(Kind kind, double t);
  double moved(double h_s);
  double move_on(double h_s);
  bool wait_with(const Move& move);
  void begin_waiting();
  void settle_offset();
  void ramp_to(const Joints& dq, double a, double h_s);
  void ramp_twist(double h_s);
  bool in_reach(const Joints& q) const;

  MotionLimits limits_;
  Frame tool_;
  Kind kind_ = Kind::kRest;
  bool busy_ = false;
  Stop fault_;
  Move waiting_;  // waits for the arm to be at rest
  bool waits_ = false;
  Joints q_ = Joints::Zero(), dq_ = Joints::Zero();
  double left_s_ = 0.0;  // of a command with a given time; infinite: until its speed is reached
  double a_ = 0.0;
  Joints goal_ = Joints::Zero();  // of servoj or speedj
  Vector6 twist_ = Vector6::Zero(), twist_goal_ = Vector6::Zero();
  ServoLaw law_;
  MovePath path_;
  ForceLaw force_law_;
  Joints offset_ = Joints::Zero(), offset_dq_ = Joints::Zero();  // of force mode
};

}  // namespace tactus::ur
