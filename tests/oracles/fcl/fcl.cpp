#include "tests/oracles/fcl/fcl.hpp"

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/narrowphase/distance.h>

namespace fcl_oracle {
namespace {

fcl::Transform3d transform(const FclPlace& at) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    t.translation()[i] = at.p[i];
    for (int j = 0; j < 3; ++j) t.linear()(i, j) = at.r[i][j];
  }
  return t;
}

/// FCL's capsules lie along z.
fcl::Transform3d transform(const FclCapsule& capsule, const FclPlace& at) {
  fcl::Transform3d t = fcl::Transform3d::Identity();
  t.translation() = fcl::Vector3d(capsule.centre);
  t.linear() = fcl::Quaterniond::FromTwoVectors(fcl::Vector3d::UnitZ(), fcl::Vector3d(capsule.axis))
                   .toRotationMatrix();
  return transform(at) * t;
}

double distance(const fcl::CollisionGeometryd& one, const fcl::Transform3d& at,
                const fcl::CollisionGeometryd& other, const fcl::Transform3d& other_at) {
  fcl::DistanceRequestd request;
  request.gjk_solver_type = fcl::GST_INDEP;
  fcl::DistanceResultd result;
  return fcl::distance(&one, at, &other, other_at, request, result);
}

}  // namespace

double fcl_distance(const FclCapsule& one, const FclPlace& at, const FclCapsule& other,
                    const FclPlace& other_at) {
  const fcl::Capsuled a(one.radius, one.length), b(other.radius, other.length);
  return distance(a, transform(one, at), b, transform(other, other_at));
}

double fcl_distance(const FclCapsule& one, const FclPlace& at, const FclBox& box,
                    const FclPlace& box_at) {
  const fcl::Capsuled a(one.radius, one.length);
  const fcl::Boxd b(box.size[0], box.size[1], box.size[2]);
  return distance(a, transform(one, at), b, transform(box_at));
}

}  // namespace fcl_oracle
