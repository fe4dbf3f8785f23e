// Admittance control: the pose that a tool on springs and dampers would have.
//
//   M de'' + D de' + K de = h - h_d          [Risi et al. 2026, eqs. 4 and 5; Newman 1992; Villani
//   x_c = x_d moved by de                    and De Schutter 2016], with de = -x~ of the paper
//
// de = [dp; phi] is the displacement of the commanded pose from the desired one: a translation and
// a rotation vector, both in the compliant frame's axes A, which are those of the desired pose or
// of the base. M, D and K are diagonal there: every axis is a separate system, and its equation
// holds in these axes even while they turn. With d = A dp and f = A phi in base axes and Omega the
// angular velocity of A,
//
//   p_c = p_d + d               v_c = v_d + A dp' + Omega x d
//   R_c = exp(f) R_d            w_c = J_l(f) (A phi' + Omega x f) + exp(f) w_d
//
// h is the wrench that the environment exerts on the tool, at the tip, in base axes: the tool
// yields along +x if it is pushed along +x. To press on a surface with a force F, h_d is -F there.
// Moments are about the measured tip.
//
// State per axis: displacement e and velocity v. The force is constant for a period and the
// solution exact (kernel/math/mass_spring_damper.hpp), so all M > 0, D >= 0, K >= 0 are stable at
// every period and the response does not depend on it. Then, in this order,
//
//   e+ is kept within e +- max_velocity T, v+ within +- max_velocity
//   e+ is kept within +- max_displacement; there v+ does not point outwards
//
// The bounds act on the state itself, so nothing winds up. The largest step of v_c on an axis is
// max_velocity, when the axis reaches max_displacement.
//
// When M, D or K change, e and v stay, and so does the force on the mass: the difference of spring
// and damper fades (kernel/math/bumpless_transfer.hpp).
//
// When braked, v goes to zero on each axis with half the robot's acceleration limit of the tip,
// within the same bounds, and e is held there: neither wrench nor spring moves it any more.
#pragma once

#include <array>

#include "kernel/core/brake.hpp"
#include "kernel/core/describe.hpp"
#include "kernel/core/joint_limits.hpp"
#include "kernel/core/port.hpp"
#include "kernel/core/status.hpp"
#include "kernel/math/bumpless_transfer.hpp"
#include "kernel/math/mass_spring_damper.hpp"

namespace tactus {

/// A set of axes: bit i is axis i. The words are in the order of the values.
enum class AxisSet : int { kNone, kX, kY, kXy, kZ, kXz, kYz, kXyz };

constexpr const char* name(AxisSet axes) {
  switch (axes) {
    case AxisSet::kNone: return "none";
    case AxisSet::kX: return "x";
    case AxisSet::kY: return "y";
    case AxisSet::kXy: return "xy";
    case AxisSet::kZ: return "z";
    case AxisSet::kXz: return "xz";
    case AxisSet::kYz: return "yz";
    case AxisSet::kXyz: return "xyz";
  }
  return nullptr;
}

enum class CompliantFrame : int { kDesired, kBase };

constexpr const char* name(CompliantFrame frame) {
  switch (frame) {
    case CompliantFrame::kDesired: return "desired";
    case CompliantFrame::kBase: return "base";
  }
  return nullptr;
}

/// Meaning of the damping parameters: D itself, or zeta in D = 2 zeta sqrt(M K).
enum class DampingGiven : int { kAsValue, kAsRatio };

constexpr const char* name(DampingGiven given) {
  switch (given) {
    case DampingGiven::kAsValue: return "value";
    case DampingGiven::kAsRatio: return "ratio";
  }
  return nullptr;
}

class Admittance {
 public:
  static constexpr const char* kType = "admittance";

  struct Params {
    CompliantFrame frame = CompliantFrame::kDesired;
    AxisSet translation = AxisSet::kXyz, rotation = AxisSet::kXyz;  ///< other axes are rigid
    DampingGiven damping_given = DampingGiven::kAsValue;
    Vector3 mass = Vector3::Constant(kRequired);                  ///< kg
    Vector3 inertia = Vector3::Constant(kRequired);               ///< kg m^2
    Vector3 damping = Vector3::Constant(kRequired);               ///< N s/m, or 1
    Vector3 rotational_damping = Vector3::Constant(kRequired);    ///< N m s/rad, or 1
    Vector3 stiffness = Vector3::Constant(kRequired);             ///< N/m
    Vector3 rotational_stiffness = Vector3::Constant(kRequired);  ///< N m/rad
    // Bounds, the same on each of three axes.
    double max_displacement = 0.1;      ///< m
    double max_rotation = 0.5;          ///< rad; three axes of 1.8 are less than half a turn
    double max_velocity = 0.25;         ///< m/s
    double max_angular_velocity = 1.0;  ///< rad/s
    double max_force = 100.0;           ///< N, of h - h_d
    double max_moment = 10.0;           ///< N m
  } params;
  In<Quantity::kPose> x_d;
  In<Quantity::kTwist> v_d;  ///< not wired: zero; v_c is that of x_c only if this is that of x_d
  In<Quantity::kWrench> h, h_d;  ///< h_d is zero if not wired
  Out<Quantity::kPose> x_c;
  Out<Quantity::kTwist> v_c;
  Out<Quantity::kFlag> limited;  ///< a bound acts in this cycle

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.choice("frame", params.frame);
    visit.choice("compliant_translation", params.translation);
    visit.choice("compliant_rotation", params.rotation);
    visit.choice("damping_given_as", params.damping_given);
    visit.tunable("mass", params.mass, kMasses, "kg");
    visit.tunable("inertia", params.inertia, kMasses, "kg m^2");
    visit.tunable("damping", params.damping, kGains, "N s/m, or 1 for a ratio");
    visit.tunable("rotational_damping", params.rotational_damping, kGains,
                  "N m s/rad, or 1 for a ratio");
    visit.tunable("stiffness", params.stiffness, kGains, "N/m");
    visit.tunable("rotational_stiffness", params.rotational_stiffness, kGains, "N m/rad");
    visit.param("max_displacement", params.max_displacement, Range{0.0, 1.0}, "m");
    visit.param("max_rotation", params.max_rotation, Range{0.0, 1.8}, "rad");
    visit.param("max_velocity", params.max_velocity, Range{0.0, 2.0}, "m/s");
    visit.param("max_angular_velocity", params.max_angular_velocity, Range{0.0, 10.0}, "rad/s");
    visit.param("max_force", params.max_force, Range{0.0, 1e4}, "N");
    visit.param("max_moment", params.max_moment, Range{0.0, 1e3}, "N m");
    visit.in("x_d", x_d);
    visit.optional("v_d", v_d);
    visit.in("h", h);
    visit.optional("h_d", h_d);
    visit.out("x_c", x_c);
    visit.out("v_c", v_c);
    visit.out("limited", limited);
  }

  /// Starts without displacement: the commanded pose is the desired one. Returns what judge() does;
  /// otherwise as step(). [init]
  [[gnu::cold]] Status start();
  /// Returns kBadValue if a ratio is given for the damping of a compliant axis without stiffness,
  /// where it gives none. [init]
  [[gnu::cold]] Status judge() const;

  /// Returns kCommandNotFinite if an input or the command is not finite. The first step after a
  /// change of period computes the coefficients again. [cyclic]
  Status step(double dt_s);

  /// Brings the displacement to rest and holds it until the next start(). [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) { braked_ = true; }
  /// True if the displacement does not move. [between two cycles]
  bool at_rest() const;
  /// Changes the tunable parameters: displacement, velocity and the force on each mass go on, and
  /// what spring and damper exert differently fades in kTransfer_s. [between two cycles], after a
  /// step
  void retune(const Params& next, const JointLimits& limits);

 private:
  static constexpr Range kMasses = {1e-4, 1e4}, kGains = {0.0, 1e6};

  struct Axis {
    bool compliant = false;
    double mass = 1.0, damping = 0.0, stiffness = 0.0;
    double max_displacement = 0.0, max_velocity = 0.0, max_force = 0.0;
    double deceleration = 0.0;
    MassSpringDamper law;
    MassSpringDamper::State state;

    /// Advances one period under `force`, which is bounded, and what fades; true if a bound acted.
    bool move(double force, double fading, double dt_s);
    /// Advances one period towards rest.
    void brake(double dt_s);
    /// Returns the next state kept within the bounds, given the present one.
    MassSpringDamper::State bounded(const MassSpringDamper::State& wanted, double dt_s) const;
  };

  Axis axis_of(int i) const;
  bool inputs_finite() const;
  /// Returns the axes of the compliant frame in the base.
  Matrix3 frame() const;
  Status command();

  std::array<Axis, 6> axes_;  // three translations, three rotations
  double period_s_ = 0.0;     // of the laws
  bool braked_ = false;
  BumplessTransfer<Vector6> transfer_;  // N and N m, in the compliant axes
};

}  // namespace tactus
