// Contact: the force between the ball at the tip of a tool and a box that does not move. Pure
// functions; the integrator keeps the state of the bristle.
//
// Normal: Hunt and Crossley, J. Appl. Mech. 42 (1975), with a linear spring. With the depth of
// penetration delta and its rate ddelta,
//
//   N = k delta (1 + d ddelta)   while delta > 0 and the bracket is positive, else 0
//
// It starts from zero at touch-down and never pulls.
//
// Tangential: the single-state elastoplastic friction of Dupont, Hayward, Armstrong and Altpeter,
// IEEE Trans. Automatic Control 47 (2002), whose breakaway deflection is that of steady sliding.
// A part dz of the relative velocity v of the surfaces deflects a bristle by z; the rest is slip:
//
//   F = -(k_t z + d_t dz)   with dz = v       where |F| <= mu N: it sticks, without creep
//   |F| = mu N, against k_t z + d_t v         otherwise: it slips, and dz follows from F
//
// At constant velocity the bristle comes to rest and F = -mu N v / |v|. The slip always has the
// direction opposite to the force, so friction never adds energy.
#pragma once

#include "kernel/core/types.hpp"

namespace tactus {

/// A box that does not move.
struct Box {
  Pose pose;                               ///< of its centre, in the base frame
  Vector3 half_extents = Vector3::Zero();  ///< m, along its own axes
};

struct Material {
  double stiffness = 1e5;    ///< k, N/m
  double dissipation = 1.0;  ///< d, s/m; a ball that meets it at v leaves at v (1 - 2/3 d v)
  double friction = 0.3;     ///< mu

  /// k_t, N/m. Between two bodies of the same elastic material it is 2 (1 - nu) / (2 - nu) of the
  /// normal one (Mindlin 1949): 0.67 to 0.82 for a Poisson ratio nu of 0.5 to 0.3.
  double bristle_stiffness() const { return 0.7 * stiffness; }
  /// d_t, N s/m: the oscillation of a sticking tip of mass m dies by 1/e in 2 m / d_t, a fifteenth
  /// of a second for 2 kg.
  static constexpr double kBristleDamping = 60.0;
};

/// The touch of a ball and a box.
struct Touch {
  Vector3 normal = Vector3::UnitZ();  ///< out of the box, unit, base frame
  double depth = 0.0;                 ///< m; negative while they are apart
};

/// Finds the shortest distance between a ball (centre in the base frame, radius >= 0, m) and a box.
/// The depth is continuous everywhere; the normal jumps if two faces are equally near a centre
/// inside the box. [any]
Touch find_touch(const Box& box, const Vector3& centre, double radius);

/// Returns N in newtons; `depth` in m, `depth_rate` in m/s. [any]
double normal_force(const Material& material, double depth, double depth_rate);

/// Returns the part of `v` in the tangent plane of `normal`. [any]
Vector3 tangential(const Vector3& v, const Vector3& normal);

/// Returns F, the force of the box on the ball, N, from the bristle's deflection if it sticks (m)
/// and the velocity of the surface of the ball (m/s), both in the tangent plane. [any]
Vector3 friction_force(const Material& material, double normal_force, const Vector3& deflection,
                       const Vector3& velocity);

/// Returns the bristle after `h_s` > 0, in which the surface of the ball moved by `moved`, m, in
/// the tangent plane. The implicit Euler method is stable for every stiffness and step; the stored
/// energy never grows by more than the work done on the bristle. [any]
Vector3 next_bristle(const Material& material, double normal_force, const Vector3& bristle,
                     const Vector3& moved, double h_s);

/// Returns the energy that a contact of this depth and bristle stores, J. [any]
double stored_energy(const Material& material, double depth, const Vector3& bristle);

}  // namespace tactus
