// Cartesian pose control: closed-loop inverse kinematics by damped least squares.
//
//   e    = [p_d - p ; log(r_d r^-1)] - measurement_delay v_d        base frame, shortest arc
//   v    = v_d + K e
//   dq_c = J# v + (I - J# J) k_n (q_posture - q)        [Risi et al. 2026, eq. 6; Chiacchio et al.
//   q_c  = integral of dq_c                              1991; J#: kernel/math/damped_inverse.hpp]
//
// Remaining errors. If the target is out of reach, e does not vanish, and J turns with the joints:
// near rest the loop is
//   d(dq_c) = -K (J^T J + lambda^2 I)^-1 (J^T J + H) dq,    H = -sum over i of e_i Hessian(x_i)
// With a Hessian of length h, H is of the order of h |e|, and in a direction in which J loses rank
// the gain is K h |e| / lambda^2: for K = 10 1/s and h = 0.25 m, 0.3 m out of reach and with a
// damping of 0.05, this is 300 1/s and drives a servo that lags by 5 ms into a limit cycle.
// Therefore corrections, and only they, are damped by lambda_c^2 >= kBend |e| - sigma^2 [Sugihara,
// IEEE Trans. Robotics 27, 2011, also lets the damping grow with the error]. The gain is then at
// most about K in every direction whatever the error, and the loop tolerates the same lag out of
// reach as within reach. Two stretched links a and b are shortened by a b / (a + b) theta^2 / 2
// when bent: h <= reach / 4, 0.33 m for the longest arm here. kBend is half as large again. Where
// sigma^2 > kBend |e| nothing changes. |e| counts only as far as it is corrected: K e no faster
// than the tip may move.
//
// Discretisation: the pose error of this period is corrected during the next, q_c(k) = q_c(k-1) +
// dt dq_c(k). With a servo that is at q_c(k) when period k ends, e(k+1) = (1 - K dt) e(k), and the
// response is exp(-K t) at every period, within the fraction K dt / 2. x, J and q are measured; a
// measurement of known age is compared with the reference at its time.
//
// A robot that executes motions at a share s of their speed lags longer by 1 / s. Errors are then
// corrected with s K, so that the loop is the same in the robot's own time, and stops when the
// robot does.
//
// Limits, in this order:
//   - a joint that may not move further is left out, and the others take over its part of the task;
//   - the whole twist is scaled until tool and joints keep their speed limits, with its direction;
//   - the posture takes the remaining speed;
//   - a large error is corrected no faster than the joints can brake with half their acceleration;
//   - JointIntegrator bounds the result: position, velocity, lead, acceleration.
//
// When K changes, the difference of the correction fades (kernel/math/bumpless_transfer.hpp); the
// posture's velocity changes with a bounded acceleration anyway.
//
// While the reference rests, so does the tip: kSettles_s after x_d has last moved by a quarter of
// hold_tolerance, e may not differ by more than that from its mean, where a metre counts as a
// radian, nor |e| grow by more. A tip that swings or circles about its reference is found within
// half a swing; one that stands out of reach stays there, or creeps along its edge.
//
// When braked on the path, the posture's velocity goes to zero, and once the reference is at rest,
// the remaining error is corrected for no longer than kRunDown_s and never faster than before. When
// braked at once, every joint stops separately with max_acceleration.
#pragma once

#include <algorithm>

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/math/bumpless_transfer.hpp"
#include "kernel/math/damped_inverse.hpp"
#include "kernel/math/joint_integrator.hpp"

namespace tactus {

class CartesianPose {
 public:
  static constexpr const char* kType = "cartesian_pose";

  struct Params {
    Vector3 position_gain = Vector3::Constant(10.0);  ///< 1/s
    Vector3 rotation_gain = Vector3::Constant(10.0);  ///< 1/s
    double measurement_delay = 0.0;              ///< s; age of x in step(); zero for an ideal servo
    double damping_onset = 0.05;                 ///< sigma below which the inverse is damped
    double posture_gain = 0.5;                   ///< 1/s; zero: no posture
    double max_lead = 0.1;                       ///< rad; more than the servo's lag at speed
    double max_speed = Robot::kTaskLimit.v_max;  ///< m/s
    double max_angular_speed = Robot::kTaskLimit.w_max;  ///< rad/s
    double hold_tolerance = 0.05;                        ///< m, and rad; 0: not checked
    JointLimits limits;
    JointVector position_margin = JointVector::Constant(0.01);  ///< rad, off both limits
  } params;
  In<Quantity::kPose> x_d;         ///< desired pose of the tip
  In<Quantity::kTwist> v_d;        ///< twist of x_d; not wired: zero
  In<Quantity::kPose> x;           ///< measured
  In<Quantity::kJacobian> J;       ///< at the measured joints
  In<Quantity::kJointPosition> q;  ///< measured
  /// Not wired: the joints at start(), towards which they move only while x_d moves.
  In<Quantity::kJointPosition> q_posture;
  In<Quantity::kScalar> speed_scaling;  ///< of the robot, 0 to 1; not wired: 1
  Out<Quantity::kJointPosition> q_c;
  Out<Quantity::kJointVelocity> dq_c;
  Out<Quantity::kScalar> scale;    ///< share of the twist v that speed limits leave, 0 to 1
  Out<Quantity::kScalar> sigma;    ///< distance of the whole arm from a singularity
  Out<Quantity::kScalar> damping;  ///< lambda; zero: the inverse is exact

  /// Returns the deceleration of every joint in a brake at once, rad/s^2. [any]
  const JointVector& deceleration() const { return params.limits.ddq_max; }

  /// Tightens the limits of position and velocity of the joints. [init]
  [[gnu::cold]] void keep_within(const JointLimits& limits) {
    for (int i = 0; i < kDof; ++i) {
      params.limits.q_min[i] = std::max(params.limits.q_min[i], limits.q_min[i]);
      params.limits.q_max[i] = std::min(params.limits.q_max[i], limits.q_max[i]);
      params.limits.dq_max[i] = std::min(params.limits.dq_max[i], limits.dq_max[i]);
    }
  }

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.tunable("position_gain", params.position_gain, Range{0.0, 1000.0}, "1/s");
    visit.tunable("rotation_gain", params.rotation_gain, Range{0.0, 1000.0}, "1/s");
    visit.param("measurement_delay", params.measurement_delay, Range{0.0, 0.1}, "s");
    visit.param("damping_onset", params.damping_onset, Range{1e-3, 1.0}, "1");
    visit.tunable("posture_gain", params.posture_gain, Range{0.0, 10.0}, "1/s");
    visit.param("max_lead", params.max_lead, Range{1e-4, 1.0}, "rad");
    visit.param("max_speed", params.max_speed, Range{1e-3, Robot::kTaskLimit.v_max}, "m/s");
    visit.param("max_angular_speed", params.max_angular_speed, Range{1e-3, Robot::kTaskLimit.w_max},
                "rad/s");
    visit.param("hold_tolerance", params.hold_tolerance, Range{0.0, 3.0}, "1");
    visit.limit("max_velocity", params.limits.dq_max, "rad/s");
    visit.limit("max_acceleration", params.limits.ddq_max, "rad/s^2");
    visit.param("position_margin", params.position_margin, Range{0.0, 0.5}, "rad");
    visit.in("x_d", x_d);
    visit.optional("v_d", v_d);
    visit.in("x", x);
    visit.in("J", J);
    visit.in("q", q);
    visit.optional("q_posture", q_posture);
    visit.optional("speed_scaling", speed_scaling);
    visit.out("q_c", q_c);
    visit.out("dq_c", dq_c);
    visit.out("scale", scale);
    visit.out("sigma", sigma);
    visit.out("damping", damping);
  }

  /// Holds the measured position. Returns what judge() does; kStateNotFinite. [init]
  [[gnu::cold]] Status start(double dt_s);
  /// Returns kUnstableGain unless every gain times (dt_s + measurement_delay) is at most
  /// kMaxGainPeriods. [init]
  [[gnu::cold]] Status judge(double dt_s) const;

  /// Returns kStateNotFinite (x, J, q), kReferenceFault (x_d, v_d, q_posture, speed_scaling; a
  /// quaternion of no length) or kCommandNotFinite; the command then keeps its position, at rest.
  /// kPathTolerance: the tip leaves a reference that rests; the command continues. [cyclic]
  Status step(double dt_s);
  /// Verdict of the last step() on a reference at rest: kOk, or kPathTolerance with axis 0
  /// (translation) or 3 (rotation), the change of the error (a metre counts as a radian) and
  /// hold_tolerance. A brake leaves it unchanged. [between two cycles]
  Verdict held() const;

  /// Brings the arm to rest and keeps it there until the next start(); after kAtOnce without
  /// following the reference. [cyclic]
  void brake(Status /*why*/, BrakeWay way) {
    braked_ = true;
    at_once_ = at_once_ || way == BrakeWay::kAtOnce;
  }
  /// True if the joint command does not move. [between two cycles]
  bool at_rest() const { return motion_.dq().cwiseAbs().maxCoeff() <= kStill; }
  /// Lets the joint command go on from where it is; a remaining error fades in again, and the
  /// posture stays that of the start. [init]
  Status resume();
  /// Changes the tunable parameters: the correction continues, and its difference fades in
  /// kTransfer_s. [between two cycles], after a step
  void retune(const Params& next, const JointLimits& limits);

  /// Bound of gain times period. An ideal servo without delay is stable below 2 and does not
  /// overshoot below 1; with two periods of unmodelled delay the stability limit is
  /// 2 sin(pi / 10) = 0.618.
  static constexpr double kMaxGainPeriods = 0.5;

 private:
  static constexpr double kStill = 1e-6;      // rad/s
  static constexpr double kBend = 0.5;        // m, or rad
  static constexpr double kRunDown_s = 0.3;   // three times 1/K at the gains of the paper
  static constexpr double kRests = 0.25;      // of the tolerance of the hold
  static constexpr double kNearer = 0.999;    // of an error; the same is not nearer
  static constexpr double kMean_s = 2.5;      // time constant of the error's mean
  static constexpr double kSettles_s = 10.0;  // goal_time_s of the generators
  struct Demand;
  struct Task;

  double largest_gain() const;
  double excess(const Vector6& v) const;
  Vector6 error() const;
  Vector6 correction(const Vector6& e) const;
  Status command_velocity(double dt_s, JointVector& dq);
  void run_down(double dt_s);
  bool leaves(const Vector6& e, double dt_s);
  void share_out(const DampedInverse<kDof>& inverse, double dt_s, Demand& demand) const;
  Task solve(const Demand& demand, DampedInverse<kDof>& inverse, double dt_s) const;
  JointVector posture_velocity(const Task& task, const DampedInverse<kDof>& inverse, double dt_s);

  JointIntegrator motion_;
  JointVector posture_ = JointVector::Zero();  // joints at start()
  JointVector posture_dq_ = JointVector::Zero();
  bool braked_ = false, at_once_ = false;
  bool stands_ = false;                 // the reference
  BumplessTransfer<Vector6> transfer_;  // m/s and rad/s, in base axes
  double tracking_ = 1.0;  // share of the correction; falls when braked, reference at rest
  Pose last_x_d_;
  Pose held_x_d_;                   // where the reference rests
  double rests_s_ = 0.0;            // for how long
  Vector6 mean_ = Vector6::Zero();  // of the error
  double least_ = 0.0;              // |error| since it has settled
  bool left_ = false;               // the error has changed by more than the tolerance
};

}  // namespace tactus
