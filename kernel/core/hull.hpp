// Hull, LinkHulls: the points of convex bodies, as a file lists them.
#pragma once

#include <array>
#include <string_view>

#include "kernel/core/loop_bound.hpp"
#include "kernel/core/status.hpp"
#include "kernel/core/text.hpp"
#include "kernel/core/types.hpp"

namespace tactus {

/// A board on which memory is short has boxes and capsules only: TACTUS_CONVEX=0.
inline constexpr bool kConvexBodies = TACTUS_CONVEX != 0;

/// The convex hull of the points that a file lists, m, in the frame of the body. Points inside it
/// cost time and do not matter.
class Hull {
 public:
  static constexpr int kMost = kConvexBodies ? 64 : 0, kLeast = 0;

  /// Reads "x y z, x y z": any number of points. `why` has the word, its value and the limit.
  /// [init]
  Status add(std::string_view text, int line, Message& why);

  int count() const { return count_; }
  const Vector3& operator[](int i) const { return points_[static_cast<std::size_t>(i)]; }
  /// Returns the point that is farthest along n; all are looked at. At least one must be there.
  /// [cyclic]
  const Vector3& farthest(const Vector3& n) const {
    int at = 0;
    double most = points_[0].dot(n);
    LoopBound<kMost + 1> points;  // a board may have none
    for (int i = 1; i < count_; ++i) {
      points.tick();
      const double height = (*this)[i].dot(n);
      if (!(height > most)) continue;
      most = height;
      at = i;
    }
    return (*this)[at];
  }

 private:
  std::array<Vector3, kMost> points_;
  int count_ = 0;
};

/// The points of each link's hull, m, in the frame of the link; the base is link 0.
class LinkHulls {
 public:
  static constexpr int kMost = kConvexBodies ? kDof + 1 : 0, kLeast = 0;

  /// Reads "link5 x y z, x y z": the name of a link, then any number of points of its hull. `why`
  /// has the word, its value and the limit. [init]
  Status add(std::string_view text, int line, Message& why);

  /// Returns the number of links that are hulls. [any]
  int count() const {
    int links = 0;
    for (const Hull& hull : hulls_) links += hull.count() > 0 ? 1 : 0;
    return links;
  }
  /// The hull of a link, without points if the file gives none. [any]
  const Hull& operator[](int link) const { return hulls_[static_cast<std::size_t>(link)]; }

 private:
  std::array<Hull, kMost> hulls_;
};

}  // namespace tactus
