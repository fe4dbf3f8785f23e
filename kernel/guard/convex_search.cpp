// libccd proposes, this file proves. Every direction along which libccd requests the farthest
// points of the two bodies gives a lower bound of their distance, independent of libccd's own
// verdict, which is not used. One body is made thicker by what is wanted, so that the search
// continues until that is proved.
#include <ccd/ccd.h>

#include <algorithm>
#include <cmath>

#include "kernel/guard/convex.hpp"

namespace tactus {
namespace {

/// libccd compares products of four lengths with DBL_EPSILON, without a unit: in metres it gives up
/// on bodies of an arm's size that are some mm apart, in mm it does not.
constexpr double kScale = 1000.0;

/// The data that the callbacks of a search share. libccd requests the point of the first body
/// first.
struct Search {
  const Solid& one;
  const Solid& other;
  double wanted;             // m, between the cores
  double best = -kInfinity;  // m, proved between the cores
  int tried = 0;
  Vector3 at_one = Vector3::Zero(), given = Vector3::Zero();  // m; the point given to libccd, mm

  bool done() const { return best > wanted; }
};

Search& search_of(const void* object) {
  return *const_cast<Search*>(static_cast<const Search*>(object));
}

Vector3 vector_of(const ccd_vec3_t& v) {
  return {v.v[0], v.v[1], v.v[2]};
}

void put(const Vector3& from, ccd_vec3_t* to) {
  for (int i = 0; i < 3; ++i) to->v[i] = from[i];
}

void first_direction(const void* object, const void* /*same*/, ccd_vec3_t* direction) {
  const Search& search = search_of(object);
  Vector3 n = search.other.middle - search.one.middle;
  if (!(n.squaredNorm() > 0.0)) n = Vector3::UnitX();
  put(n, direction);
}

void farthest_of_one(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  Search& search = search_of(object);
  const Vector3 n = vector_of(*direction);
  if (!search.done()) {
    search.at_one = search.one.farthest(n);
    search.given = kScale * (search.at_one + search.wanted / std::sqrt(n.squaredNorm()) * n);
  }
  put(search.given, point);
}

/// libccd requests the point against the direction n of the first body; the gap along n is proved.
/// Once it is enough, the answer is a point beyond the first body: libccd ends.
void farthest_of_other(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* point) {
  Search& search = search_of(object);
  const Vector3 n = -vector_of(*direction);
  if (search.done()) return put(search.given + n, point);
  const Vector3 at_other = search.other.farthest(-n);
  const double gap = n.dot(at_other - search.at_one) / std::sqrt(n.squaredNorm());
  if (gap > search.best) search.best = gap;
  ++search.tried;
  put(kScale * at_other, point);
}

}  // namespace

double separation(const Solid& one, const Solid& other, double wanted, int& directions) {
  constexpr int kMost = 16;  // of one search
  if (directions <= 0) return -kInfinity;
  const double radii = one.convex.rounding + other.convex.rounding;
  Search search = {one, other, wanted + radii};
  ccd_t ccd = {};
  ccd.first_dir = first_direction;
  ccd.support1 = farthest_of_one;
  ccd.support2 = farthest_of_other;
  // Beside these it asks along the first direction.
  ccd.max_iterations = static_cast<unsigned long>(std::min(kMost, directions) - 1);
  static_cast<void>(ccdGJKIntersect(&search, &search, &ccd));
  directions -= search.tried;
  return search.best - radii;
}

}  // namespace tactus
