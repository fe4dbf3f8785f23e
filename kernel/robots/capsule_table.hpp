// The types of a robot's collision table, which fer_capsules.hpp and ur10_capsules.hpp fill in.
#pragma once

namespace tactus {

/// All points within `radius` of the segment from a to b, m, in the frame of a link. Link 0 is the
/// base; link i has the frame that joint i turns, counted from 1.
struct LinkCapsule {
  int link;
  double a[3], b[3];
  double radius;
};

/// Two links, the lower number first; the tool counts as the link after the last.
struct LinkPair {
  int first, second;
};

/// Two capsules, by their numbers in kCapsules from 0, the lower number first.
struct CapsulePair {
  int first, second;
};

/// The links of robot R as capsules: kLinkNames; kCapsules; kTouching, of which every capsule of
/// the one link may touch every one of the other; kNever, which cannot come within 10 mm of each
/// other at positions up to 0.05 rad beyond the joints' limits.
template <class R>
struct Capsules;

}  // namespace tactus
