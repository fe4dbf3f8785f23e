// ChunkPlan: the digital outputs of the targets that path time passes.
#include <algorithm>

#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/motion/time_rounding.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "kernel/streams/chunk_plan.hpp"

#if TACTUS_CHUNK_TARGETS > 0
namespace tactus {
namespace {

/// Time by which outputs come before their targets; a delay begins once the target is passed.
template <class Space>
double ahead_s(const ChunkCurve<Space>& chunk) {
  return chunk.outputs_mask != 0 ? std::max(chunk.outputs_lead_s, 0.0) : 0.0;
}

}  // namespace

/// The newest chunk that has begun, its lead included, commands the outputs; those of the older
/// ones that are later than its beginning are void.
template <class Space>
void ChunkPlan<Space>::pass_outputs(double now_s) {
  std::size_t newest = count_ - 1;
  LoopBound<kChunkStores> waiting;
  while (newest > 0 && now_s + ahead_s(*pieces_[newest].chunk) <
                           pieces_[newest].outputs_begin_s() - kTimeRounding_s) {
    waiting.tick();
    --newest;
  }
  pass_targets(newest, now_s);
}

/// Finds the outputs of the last target of a chunk that is about to be dropped at its end, unless
/// the next one has them already.
template <class Space>
void ChunkPlan<Space>::pass_last_targets(double now_s) {
  const ChunkCurve<Space>& next = *pieces_[1].chunk;
  const bool taken_over =
      passed_target_.epoch == next.epoch && passed_target_.sequence == next.sequence;
  const bool at_end = now().end_s() <= std::min(now_s, pieces_[1].outputs_begin_s());
  if (at_end && !taken_over) pass_targets(0, now_s);
}

template <class Space>
void ChunkPlan<Space>::pass_targets(std::size_t i, double now_s) {
  const Piece& piece = pieces_[i];
  const ChunkCurve<Space>& chunk = *piece.chunk;
  if (chunk.outputs_mask == 0) return;
  const double s = i == 0 ? path_time(now_s).s : now_s - piece.zero_s;
  double until_s = s + ahead_s(chunk) + kTimeRounding_s;
  if (i + 1 < count_)
    until_s = std::min(until_s, pieces_[i + 1].outputs_begin_s() - piece.zero_s - kTimeRounding_s);
  if (!(chunk.first_s() <= until_s)) return;
  const int last = chunk.count - 1;
  const int passed = chunk.end_s() <= until_s ? last : knot_after(chunk, until_s) - 1;
  const PassedTarget target = {chunk.epoch, chunk.sequence, passed};
  if (target == passed_target_) return;
  passed_target_ = target;
  const auto at = static_cast<std::size_t>(passed);
  passed_[passed_[0].any ? 1 : 0] = {
      true,
      {chunk.outputs[at], chunk.outputs_mask},
      std::max(chunk.knots[at].time_s - s - chunk.outputs_lead_s, 0.0)};
}

// In a unit these come after the instantiations of the class, in chunk_plan.cpp.
template void ChunkPlan<JointSpace>::pass_last_targets(double);
template void ChunkPlan<TaskSpace>::pass_last_targets(double);
template void ChunkPlan<JointSpace>::pass_outputs(double);
template void ChunkPlan<TaskSpace>::pass_outputs(double);

}  // namespace tactus
#endif
