// LinkHulls: the links of the arm as convex hulls, as the lines of [collision] list them.
#pragma once

#include "kernel/core/hull.hpp"
#include "kernel/core/types.hpp"

namespace tactus {

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
