// The words in which operators read a Status or a Verdict, with units and the code at the end.
#pragma once

#include "kernel/core/load_error.hpp"
#include "kernel/core/verdict.hpp"

namespace tactus {

/// The axes of a verdict are joints, or directions of the tool tip.
enum class VerdictAxes { kJoints, kTip };

/// The verdict that ended the cycles, and the axes it refers to.
struct FaultVerdict {
  FaultVerdict() = default;
  FaultVerdict(Status status) : verdict{status} {}  // NOLINT: a status without joint and value
  explicit FaultVerdict(const Verdict& found, VerdictAxes of = VerdictAxes::kJoints)
      : verdict(found), axes(of) {}

  Verdict verdict;
  VerdictAxes axes = VerdictAxes::kJoints;
};

/// "following error beyond its limit (76)". [any]
Message describe(Status status);

/// "waypoint 2 (t = 1.5 s), joint 4 (fer_joint4): velocity -2.18 rad/s exceeds 2.175 rad/s (36)",
/// without the parts that the verdict does not have; the time of the waypoint if it is finite.
/// [any]
Message describe(const Verdict& verdict, VerdictAxes axes, double time_s = kInfinity);

/// Returns the remedy for a refused reference, such as "; give this part more time"; empty if none
/// is known. [any]
const char* remedy(const Verdict& verdict);
/// Returns the remedy for a goal that was not followed or reached: settings of the reference
/// generator and, if a law has gains, of the law. Empty for any other Status. [any]
Message goal_remedy(Status status, VerdictAxes axes, bool law);

}  // namespace tactus
