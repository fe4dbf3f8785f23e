// Motion: the set-point generator of the controller. A script gives it one command at a time; it
// moves the joint targets from cycle to cycle, by a time base that the speed slider stretches.
//
//   movej, movel   a trapezoid of speed from rest to rest, on the leading axis or on the line
//   servoj         servo_law.hpp, for t seconds
//   speedj, speedl a linear change of speed, for t seconds or until it is reached; then it is held
//   stopj          a linear change to rest
//
// A target that cannot be followed is a fault: a protective stop.
#pragma once

#include <limits>

#include "sim_plant/ur/kinematics.hpp"
#include "sim_plant/ur/safety_codes.hpp"
#include "sim_plant/ur/servo_law.hpp"
#include "sim_plant/ur/trapezoid.hpp"

namespace tactus::ur {

/// What of the path check is not published; rad, rad/s and rad/s^2.
struct MotionLimits {
  Joints speed;                    ///< what the joints move at most
  double position = 6.3355;        ///< 363 degrees: the default safety limit
  double sudden_change = 0.5;      ///< between a servo set-point and the target it is to move
  double sudden_stop = 0.1;        ///< a target speed from which standing still is one
  double stop_acceleration = 4.0;  ///< of a program that ends
  double protective_acceleration = 12.0;

  MotionLimits();
};

class Motion {
 public:
  explicit Motion(const MotionLimits& limits = {}) : limits_(limits) {}

  /// At rest at `q`; every command is forgotten. [any]
  void rest(const Joints& q);
  /// The tip in the flange, for the commands in tool space. [any]
  void set_tool(const Frame& tool) { tool_ = tool; }
  const Frame& tool() const { return tool_; }

  /// The commands of a script. A speed, acceleration or time that is not positive takes the default
  /// of the script manual. False: the target cannot be reached, nothing moves.
  bool move_j(const Joints& q, double a, double v, double t);
  bool move_l(const Frame& target, double a, double v, double t);
  void servo_j(const Joints& q, double t, const ServoLaw& law);
  void speed_j(const Joints& dq, double a, double t);
  void speed_l(const Vector6& twist, double a, double t);
  void stop_j(double a);

  /// The program that gave the last command is gone: whoever comes next finds the arm moving.
  void abandon() { busy_ = false; }

  /// The script is at a command that has not returned. [any]
  bool busy() const { return busy_; }
  /// Speed of zero and no command under way that would change it. [any]
  bool resting() const { return dq_.isZero(0.0) && !busy_; }

  /// Moves by at most `h_s` of the stretched time base; returns how much the command took. [cyclic]
  double advance(double h_s);
  /// For `h_s` the script gives no command. `playing`: there is a script; else the arm comes to
  /// rest. [cyclic]
  void idle(double h_s, bool playing);
  /// The brake of a protective stop; nothing else is heard until the arm stands. [cyclic]
  void brake(double h_s);

  /// Why the last step could not be made; kNone if it could. Reading clears it. [cyclic]
  Stop take_fault();

  const Joints& q() const { return q_; }    ///< the targets, rad
  const Joints& dq() const { return dq_; }  ///< their speed by the stretched time base, rad/s
  const MotionLimits& limits() const { return limits_; }

 private:
  static constexpr double kForever = std::numeric_limits<double>::infinity();
  enum class Kind : std::uint8_t {
    kRest,
    kMoveJ,
    kMoveL,
    kServo,
    kSpeedJ,
    kSpeedL,
    kStop,
    kBrakeFirst
  };
  /// A move that waits for the arm to stand.
  struct Move {
    bool line = false;
    Joints q = Joints::Zero();
    Frame target;
    double a = 0.0, v = 0.0, t = 0.0;
  };

  void begin(Kind kind, double t);
  double moved(double h_s);
  bool brake_first(const Move& move);
  void begin_waiting();
  void follow_line(double h_s);
  void ramp_to(const Joints& dq, double a, double h_s);
  void ramp_twist(double h_s);
  bool in_reach(const Joints& q) const;

  MotionLimits limits_;
  Frame tool_;
  Kind kind_ = Kind::kRest;
  bool busy_ = false;
  Stop fault_;
  Move waiting_;
  Joints q_ = Joints::Zero(), dq_ = Joints::Zero();
  double left_s_ = 0.0;  // of a command that lasts a given time; infinite: until it is reached
  double a_ = 0.0;
  Joints goal_ = Joints::Zero();  // servoj, speedj
  Vector6 twist_ = Vector6::Zero(), twist_goal_ = Vector6::Zero();
  ServoLaw law_;
  Trapezoid time_law_;
  double time_s_ = 0.0;  // on the time law
  Joints from_ = Joints::Zero(), way_ = Joints::Zero();
  Frame line_from_, line_to_;
  Vector3 turn_ = Vector3::Zero();  // from the one orientation to the other, in the first
};

}  // namespace tactus::ur
