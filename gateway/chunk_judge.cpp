// What a chunk must be before its curve is fitted: every number finite, times that can be told
// apart, and motions that limits can shape.
#include <cmath>

#include "gateway/chunk_fit.hpp"
#include "kernel/reference/motion/time_rounding.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/judge_channels.hpp"
#include "kernel/reference/space/task_space.hpp"

#if TACTUS_CHUNK_TARGETS > 0
namespace tactus {
namespace {

/// Judges the mean velocity from one target to the next: limits shape what exceeds them a little.
template <class Space>
Verdict judge_step(const typename Space::Point& from, const typename Space::Point& to, double dt_s,
                   const typename Space::Limits& limits) {
  constexpr double kMostOver = 4.0;
  Verdict verdict = judge_reach<Space>(from, to, limits, kMostOver * dt_s);
  verdict.value *= kMostOver;
  verdict.limit *= kMostOver;
  return verdict;
}

}  // namespace

template <class Space>
Verdict judge_chunk(const Chunk<Space>& chunk, const AdmissionSettings<Space>& settings) {
  if (chunk.count < 1 || chunk.count > kChunkTargets)
    return {Status::kReferenceSize, -1, -1, static_cast<double>(chunk.count),
            static_cast<double>(kChunkTargets)};
  if (!(chunk.fade_s >= 0.0 && chunk.fade_s <= kLongestFade_s))
    return {Status::kBadValue, -1, -1, chunk.fade_s, kLongestFade_s};
  if (!(chunk.smoothing_s >= 0.0 && chunk.smoothing_s < kInfinity))
    return {Status::kBadValue, -1, -1, chunk.smoothing_s, 0.0};
  if (!(std::abs(chunk.outputs_lead_s) <= kLongestLead_s))
    return {Status::kBadValue, -1, -1, chunk.outputs_lead_s, kLongestLead_s};
  const typename Space::Limits limits = Space::known_limits(chunk.header, settings.limits);
  const typename Space::Placement placement = Space::anywhere(chunk.header, limits);
  double earliest_s = -kInfinity;
  for (int i = 0; i < chunk.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double time_s = chunk.time_s[k];
    if (!std::isfinite(time_s)) return {Status::kReferenceNotFinite, i, -1, time_s, 0.0};
    if (!(time_s >= earliest_s)) return {Status::kReferenceTime, i, -1, time_s, earliest_s};
    if (!(time_s - chunk.time_s[0] <= kLongestChunk_s))
      return {Status::kReferenceTime, i, -1, time_s, chunk.time_s[0] + kLongestChunk_s};
    earliest_s = time_s + settings.period_s - kTimeRounding_s;
    typename Space::Point placed = Space::placed(chunk.targets[k], placement);
    static_cast<void>(Space::saturate(placed, limits));  // as fit_chunk() does, which tells
    Verdict verdict = Space::judge_waypoint(placed, limits);
    if (verdict.ok() && chunk.velocities)
      verdict = judge_velocity<Space>(Space::rates(chunk.targets[k]), limits);
    if (verdict.ok() && i > 0)
      verdict = judge_step<Space>(chunk.targets[k - 1], chunk.targets[k],
                                  time_s - chunk.time_s[k - 1], limits);
    verdict.waypoint = i;
    if (!verdict.ok()) return verdict;
  }
  return {};
}

template Verdict judge_chunk(const Chunk<JointSpace>&, const AdmissionSettings<JointSpace>&);
template Verdict judge_chunk(const Chunk<TaskSpace>&, const AdmissionSettings<TaskSpace>&);

}  // namespace tactus
#endif
