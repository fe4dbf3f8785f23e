// The vocabulary of a robot's collision table: what fer_capsules.hpp and its kin fill in.
#pragma once

namespace tactus {

/// All points within `radius` of the segment from a to b, m, fixed to a link. Link 0 is the base
/// and link i the frame that joint i turns, counted from 1.
struct LinkCapsule {
  int link;
  double a[3], b[3];
  double radius;
};

/// Two links, the lower first; the tool counts as the link after the last.
struct LinkPair {
  int first, second;
};

}  // namespace tactus
