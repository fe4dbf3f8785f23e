#include "kernel/guard/separation.hpp"

#include <ccd/ccd.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace tactus {
namespace {

static_assert(std::is_same_v<ccd_real_t, double>);

Vector3 from_ccd(const ccd_vec3_t* v) {
  return {v->v[0], v->v[1], v->v[2]};
}

void to_ccd(const Vector3& v, ccd_vec3_t* to) {
  for (int i = 0; i < 3; ++i) to->v[i] = v[i];
}

/// Return the point farthest along d.
Vector3 support(const Capsule& c, const Vector3& d) {
  return (d.dot(c.b - c.a) > 0.0 ? c.b : c.a) + c.radius / std::sqrt(d.dot(d)) * d;
}

Vector3 support(const BoxShape& box, const Vector3& d) {
  Vector3 corner = box.half;
  for (int i = 0; i < 3; ++i)
    if (box.r.col(i).dot(d) < 0.0) corner[i] = -corner[i];
  return box.centre + box.r * corner;
}

/// A pair, and the result of libccd's questions about it.
template <class Other>
struct Query {
  Capsule capsule;  // with the radii of both
  Other other;
  double ahead = 0.0;  // reach of the capsule along the direction asked for
  Separation result;

  /// libccd asks the first shape for its farthest point along d, then the second along -d.
  static void ask_capsule(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    auto& query = *static_cast<Query*>(const_cast<void*>(object));
    const Vector3 d = from_ccd(direction), p = support(query.capsule, d);
    query.ahead = d.dot(p);
    ++query.result.support_calls;
    to_ccd(p, point);
  }
  static void ask_other(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
    auto& query = *static_cast<Query*>(const_cast<void*>(object));
    const Vector3 d = from_ccd(direction), p = support(query.other, d);
    // Along -d the capsule ends at `ahead`, and the other begins at -d.p.
    if (query.ahead + d.dot(p) < 0.0) query.result.proved = true;
    ++query.result.support_calls;
    to_ccd(p, point);
  }
  static void first_direction(const void* object, const void*, ccd_vec3_t* direction) {
    const auto& query = *static_cast<const Query*>(object);
    to_ccd(centre_of(query.other) - query.capsule.centre(), direction);
  }
  static Vector3 centre_of(const Capsule& capsule) { return capsule.centre(); }
  static Vector3 centre_of(const BoxShape& box) { return box.centre; }
};

template <class Other>
Separation run(Query<Other> query) {
  ccd_t ccd{};
  ccd.first_dir = Query<Other>::first_direction;
  ccd.support1 = Query<Other>::ask_capsule;
  ccd.support2 = Query<Other>::ask_other;
  ccd.max_iterations = kGjkIterations;
  static_cast<void>(ccdGJKIntersect(&query, &query, &ccd));
  return query.result;
}

}  // namespace

Separation separate(const Capsule& capsule, const Capsule& other, double inflation) {
  const double thickness = capsule.radius + other.radius + inflation;
  // The first takes the radii of both; the other is only its segment.
  return run(Query<Capsule>{{capsule.a, capsule.b, thickness}, {other.a, other.b, 0.0}, 0.0, {}});
}

Separation separate(const Capsule& capsule, const BoxShape& box, double inflation) {
  return run(Query<BoxShape>{{capsule.a, capsule.b, capsule.radius + inflation}, box, 0.0, {}});
}

bool far_apart(const Capsule& capsule, const Capsule& other, double inflation) {
  const double reach = 0.5 * std::sqrt((capsule.b - capsule.a).squaredNorm()) + capsule.radius +
                       0.5 * std::sqrt((other.b - other.a).squaredNorm()) + other.radius +
                       inflation;
  return (capsule.centre() - other.centre()).squaredNorm() > reach * reach;
}

bool far_apart(const Capsule& capsule, const BoxShape& box, double inflation) {
  const double reach =
      0.5 * std::sqrt((capsule.b - capsule.a).squaredNorm()) + capsule.radius + inflation;
  const Vector3 centre = box.r.transpose() * (capsule.centre() - box.centre);
  Vector3 gap;
  for (int i = 0; i < 3; ++i) gap[i] = std::max(std::abs(centre[i]) - box.half[i], 0.0);
  return gap.squaredNorm() > reach * reach;
}

}  // namespace tactus
