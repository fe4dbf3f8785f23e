#include "sim_plant/arm/contact.hpp"

#include <algorithm>
#include <cmath>

namespace tactus {
namespace {

/// Returns the touch of a centre inside the box, by the nearest face.
Touch nearest_face(const Vector3& centre, const Vector3& half_extents) {
  int axis = 0;
  const double inside = (half_extents - centre.cwiseAbs()).minCoeff(&axis);
  Vector3 normal = Vector3::Zero();
  normal[axis] = centre[axis] < 0.0 ? -1.0 : 1.0;
  return {normal, inside};
}

/// Limits the force of bristle and damper to `limit`, mu N.
Vector3 within_cone(const Vector3& force, double limit) {
  const double size = force.norm();
  return size <= limit ? force : Vector3(force * (limit / size));
}

}  // namespace

Touch find_touch(const Box& box, const Vector3& centre, double radius) {
  const Vector3 c = box.pose.r.conjugate() * (centre - box.pose.p);
  const Vector3 nearest = c.cwiseMax(-box.half_extents).cwiseMin(box.half_extents);
  const Vector3 way = c - nearest;
  const double distance = way.norm();
  Touch touch =
      distance > 0.0 ? Touch{way / distance, -distance} : nearest_face(c, box.half_extents);
  touch.normal = box.pose.r * touch.normal;
  touch.depth += radius;
  return touch;
}

double normal_force(const Material& material, double depth, double depth_rate) {
  if (depth <= 0.0) return 0.0;
  return std::max(material.stiffness * depth * (1.0 + material.dissipation * depth_rate), 0.0);
}

Vector3 tangential(const Vector3& v, const Vector3& normal) {
  return v - normal * normal.dot(v);
}

Vector3 friction_force(const Material& material, double normal_force, const Vector3& deflection,
                       const Vector3& velocity) {
  const Vector3 sticking =
      material.bristle_stiffness() * deflection + Material::kBristleDamping * velocity;
  return -within_cone(sticking, material.friction * normal_force);
}

Vector3 next_bristle(const Material& material, double normal_force, const Vector3& bristle,
                     const Vector3& moved, double h_s) {
  const double k = material.bristle_stiffness(), d = Material::kBristleDamping / h_s;
  const Vector3 sticking = k * (bristle + moved) + d * moved;
  const Vector3 force = within_cone(sticking, material.friction * normal_force);
  return (force + d * bristle) / (k + d);  // equal to bristle + moved if it sticks
}

double stored_energy(const Material& material, double depth, const Vector3& bristle) {
  const double d = std::max(depth, 0.0);
  return 0.5 * (material.stiffness * d * d + material.bristle_stiffness() * bristle.squaredNorm());
}

}  // namespace tactus
