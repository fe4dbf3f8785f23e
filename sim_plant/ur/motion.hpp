// Motion: the set-point generator of the controller. A script gives it one command at a time; it
// moves the joint targets from cycle to cycle, by a time base that the speed slider stretches.
//
//   movej, movel,  a trapezoid of speed from rest to rest, on the leading axis or on the line; with
//   movep, movec   a blend radius the next move is joined at speed (move_path.hpp)
//   servoj         servo_law.hpp, for t seconds
//   speedj, speedl a linear change of speed, for t seconds or until it is reached; then it is held
//   stopj          a linear change to rest
//
// In force mode the tool is displaced beside that (force_mode.hpp), and in freedrive the targets
// are where the arm is.
//
// A target that cannot be followed is a fault: a protective stop.
#pragma once

#include <limits>

#include "sim_plant/ur/force_mode.hpp"
#include "sim_plant/ur/move_path.hpp"
#include "sim_plant/ur/safety_codes.hpp"
#include "sim_plant/ur/servo_law.hpp"

namespace tactus::ur {

class Motion {
 public:
  explicit Motion(const MotionLimits& limits = {}, const ForceSettings& force = {})
      : limits_(limits), path_(limits_), force_law_(force) {}
  Motion(const Motion&) = delete;
  Motion& operator=(const Motion&) = delete;

  /// At rest at `q`; every command is forgotten. [any]
  void rest(const Joints& q);
  /// The tip in the flange, for the commands in tool space. [any]
  void set_tool(const Frame& tool) { tool_ = tool; }
  const Frame& tool() const { return tool_; }

  /// The commands of a script. A speed, acceleration or time that is not positive takes the default
  /// of the script manual. False: the target cannot be reached, nothing moves.
  bool move(const Move& move);
  bool move_j(const Joints& q, double a, double v, double t, double r = 0.0);
  bool move_l(const Frame& target, double a, double v, double t, double r = 0.0);
  void servo_j(const Joints& q, double t, const ServoLaw& law);
  void speed_j(const Joints& dq, double a, double t);
  void speed_l(const Vector6& twist, double a, double t);
  void stop_j(double a);

  /// The program that gave the last command is gone: whoever comes next finds the arm moving.
  void abandon() { busy_ = false; }

  /// The script is at a command that has not returned. [any]
  bool busy() const { return busy_; }
  /// Speed of zero and no command under way that would change it. [any]
  bool resting() const { return dq_.isZero(0.0) && !busy_ && kind_ != Kind::kMove; }
  /// The last move has returned by its blend radius, and no other has come: the arm goes on to its
  /// point. [any]
  bool arriving() const { return kind_ == Kind::kMove && !busy_; }

  /// Moves by at most `h_s` of the stretched time base; returns how much the command took. [cyclic]
  double advance(double h_s);
  /// For `h_s` the script gives no command. `playing`: there is a script; else the arm comes to
  /// rest. [cyclic]
  void idle(double h_s, bool playing);
  /// Force mode for `h_s`: `force` is what acts on the tip, base frame. Behind its end the tool
  /// comes to rest. [cyclic]
  void yield(const ForceMode& mode, double damping, const Vector6& force, double h_s);
  /// A hand moves the arm: no command is heard, and when it lets go, the arm brakes. [cyclic]
  void carry(const Joints& q, const Joints& dq);
  /// The brake of a protective stop; nothing else is heard until the arm stands. [cyclic]
  void brake(double h_s);

  /// Why the last step could not be made; kNone if it could. Reading clears it. [cyclic]
  Stop take_fault();
  /// Blend radii overlapped, and one was left out. Reading clears it. [cyclic]
  bool take_overlap() { return path_.take_overlap(); }

  Joints q() const { return q_ + offset_; }       ///< the targets, rad
  Joints dq() const { return dq_ + offset_dq_; }  ///< their speed by the stretched time base, rad/s
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
  Move waiting_;  // for the arm to stand
  bool waits_ = false;
  Joints q_ = Joints::Zero(), dq_ = Joints::Zero();
  double left_s_ = 0.0;  // of a command that lasts a given time; infinite: until it is reached
  double a_ = 0.0;
  Joints goal_ = Joints::Zero();  // servoj, speedj
  Vector6 twist_ = Vector6::Zero(), twist_goal_ = Vector6::Zero();
  ServoLaw law_;
  MovePath path_;
  ForceLaw force_law_;
  Joints offset_ = Joints::Zero(), offset_dq_ = Joints::Zero();  // of force mode
};

}  // namespace tactus::ur
