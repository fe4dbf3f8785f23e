// Admittance control: the pose that a tool on springs and dampers would have.
//
//   M de'' + D de' + K de = h - h_d          [Risi et al. 2026, eqs. 4 and 5; Newman 1992; Villani
//   x_c = x_d moved by de                    and De Schutter 2016], with de = -x~ of the paper
//
// de = [dp; phi] is the displacement of the commanded pose from the desired one: a translation and
// a rotation vector, both in the compliant frame's axes A, which are those of the desired pose or
// of the base. M, D and K are diagonal there; every axis is a system of its own, and its equation
// is meant in these axes also while they turn. With d = A dp and f = A phi in base axes and Omega
// the angular velocity of A,
//
//   p_c = p_d + d               v_c = v_d + A dp' + Omega x d
//   R_c = exp(f) R_d            w_c = J_l(f) (A phi' + Omega x f) + exp(f) w_d
//
// h is what the environment exerts on the tool, at the tip, in base axes: pushed along +x the tool
// yields along +x. Pressing on a surface with a force F takes h_d = -F there. Moments are those
// about the measured tip.
//
// State per axis: displacement e and velocity v. The force is held for a period and the exact
// solution taken (kernel/math/mass_spring_damper.hpp), so M > 0, D >= 0, K >= 0 are stable at
// every period and the response does not depend on it. Then, in this order,
//
//   e+ is kept within e -+ max_velocity T, v+ within -+ max_velocity
//   e+ is kept within -+ max_displacement; there v+ does not point outwards
//
// What is kept is the state itself: nothing winds up behind a bound. The largest step of v_c on an
// axis is max_velocity, when it meets max_displacement.
//
// Braked, v is brought to zero on each axis with half the robot's acceleration limit of the tip,
// within the same bounds, and e is held there: neither wrench nor spring moves it any more.
#pragma once

#include <array>

#include "kernel/brake.hpp"
#include "kernel/describe.hpp"
#include "kernel/math/mass_spring_damper.hpp"
#include "kernel/port.hpp"
#include "kernel/status.hpp"

namespace tactus {

/// A set of axes: bit i is axis i. The words are in the order of the bits' value.
enum class AxisSet : int { kNone = 0, kXyz = 7 };
inline constexpr std::array<const char*, 8> kAxisSetWords = {"none", "x",  "y",  "xy",
                                                             "z",    "xz", "yz", "xyz"};

enum class CompliantFrame : int { kDesired, kBase };
inline constexpr std::array<const char*, 2> kCompliantFrameWords = {"desired", "base"};

/// How the damping parameters are meant: D itself, or zeta in D = 2 zeta sqrt(M K).
enum class DampingGiven : int { kAsValue, kAsRatio };
inline constexpr std::array<const char*, 2> kDampingGivenWords = {"value", "ratio"};

class Admittance {
 public:
  static constexpr const char* kType = "admittance";

  struct Params {
    CompliantFrame frame = CompliantFrame::kDesired;
    AxisSet translation = AxisSet::kXyz, rotation = AxisSet::kXyz;  ///< what is not in it is rigid
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
  In<Quantity::kTwist> v_d;  ///< zero if not wired; v_c is a derivative only if it is that of x_d
  In<Quantity::kWrench> h, h_d;  ///< h_d is zero if not wired
  Out<Quantity::kPose> x_c;
  Out<Quantity::kTwist> v_c;
  Out<Quantity::kFlag> limited;  ///< a bound acts in this cycle

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.choice("frame", params.frame, kCompliantFrameWords);
    visit.choice("compliant_translation", params.translation, kAxisSetWords);
    visit.choice("compliant_rotation", params.rotation, kAxisSetWords);
    visit.choice("damping_given_as", params.damping_given, kDampingGivenWords);
    visit.param("mass", params.mass, kMasses, "kg");
    visit.param("inertia", params.inertia, kMasses, "kg m^2");
    visit.param("damping", params.damping, kGains, "N s/m, or 1 for a ratio");
    visit.param("rotational_damping", params.rotational_damping, kGains,
                "N m s/rad, or 1 for a ratio");
    visit.param("stiffness", params.stiffness, kGains, "N/m");
    visit.param("rotational_stiffness", params.rotational_stiffness, kGains, "N m/rad");
    visit.param("max_displacement", params.max_displacement, Range{0.0, 1.0}, "m");
    visit.param("max_rotation", params.max_rotation, Range{0.0, 1.8}, "rad");
    visit.param("max_velocity", params.max_velocity, Range{0.0, 2.0}, "m/s");
    visit.param("max_angular_velocity", params.max_angular_velocity, Range{0.0, 10.0}, "rad/s");
    visit.param("max_force", params.max_force, Range{0.0, 1e4}, "N");
    visit.param("max_moment", params.max_moment, Range{0.0, 1e3}, "N m");
    visit.in("x_d", x_d), visit.optional("v_d", v_d);
    visit.in("h", h), visit.optional("h_d", h_d);
    visit.out("x_c", x_c), visit.out("v_c", v_c), visit.out("limited", limited);
  }

  /// No displacement: the commanded pose is the desired one. kBadValue if a ratio is to damp a
  /// compliant axis without stiffness, which it cannot; else as step(). [init]
  Status start();

  /// kCommandNotFinite if an input or the command is not finite. The first step after a change of
  /// period works the coefficients out anew. [cyclic]
  Status step(double dt_s);

  /// The displacement comes to rest and stays until the next start. [cyclic]
  void brake(Status /*why*/, BrakeWay /*way*/) { braked_ = true; }

 private:
  static constexpr Range kMasses = {1e-4, 1e4}, kGains = {0.0, 1e6};

  struct Axis {
    bool compliant = false;
    double mass = 1.0, damping = 0.0, stiffness = 0.0;
    double max_displacement = 0.0, max_velocity = 0.0, max_force = 0.0;
    double deceleration = 0.0;
    MassSpringDamper law;
    MassSpringDamper::State state;

    /// One period under `force`; true if a bound acted.
    bool move(double force, double dt_s);
    /// One period towards rest.
    void brake(double dt_s);
    /// Keeps a state within the bounds, from the one before.
    MassSpringDamper::State bounded(const MassSpringDamper::State& wanted, double dt_s) const;
  };

  Axis axis_of(int i) const;
  bool inputs_finite() const;
  /// Axes of the compliant frame, in the base.
  Matrix3 frame() const;
  Status command();

  std::array<Axis, 6> axes_;  // three translations, three rotations
  double period_s_ = 0.0;     // for which the laws hold
  bool braked_ = false;
};

}  // namespace tactus
