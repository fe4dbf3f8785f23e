#include "program/session/fault_verdict.hpp"

#include <type_traits>

#include "kernel/pipeline/with_block.hpp"

namespace tactus {
namespace {

template <class Kind, class = void>
constexpr bool kHolds = false;
template <class Kind>
constexpr bool kHolds<Kind, std::void_t<decltype(&Kind::held)>> = true;

/// The finding of a block about a reference that rests. A generator watches joints, a law the tip.
template <class Kind>
FaultVerdict held(const Kind& block) {
  if constexpr (kHolds<Kind>)
    return FaultVerdict(block.held(), std::is_same_v<Kind, CartesianPose> ? VerdictAxes::kTip
                                                                          : VerdictAxes::kJoints);
  else
    return {};
}

}  // namespace

FaultVerdict fault_verdict(Status status, const Guard& guard, const Pipeline& pipeline) {
  if (status == Status::kPathTolerance && pipeline.failure == status) {
    const FaultVerdict found =
        with_block(pipeline[pipeline.failed], [](const auto& block) { return held(block); });
    if (!found.verdict.ok()) return found;
  }
  const Guard::Telemetry& telemetry = guard.telemetry();
  return FaultVerdict(
      {status, -1, telemetry.tripped_joint, telemetry.tripped_value, telemetry.tripped_limit});
}

}  // namespace tactus
