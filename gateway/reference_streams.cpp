// ReferenceClient: chunks and velocities.
#include <cmath>

#include "gateway/chunk_fit.hpp"
#include "gateway/reference_client.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/judge_channels.hpp"
#include "kernel/reference/space/task_space.hpp"

#if TACTUS_CHUNK_TARGETS > 0
namespace tactus {
namespace {

JointSpace::Point resolved(const JointSpace::Point& base, JointSpace::Point target) {
  target.q += base.q;
  return target;
}
TaskSpace::Point resolved(const TaskSpace::Point& base, const TaskSpace::Point& target) {
  TaskSpace::Placement tip;
  tip.motion = base.x;
  tip.moved = true;
  return TaskSpace::placed(target, tip);
}

}  // namespace

template <class Space>
Verdict ReferenceClient<Space>::send(const Chunk<Space>& chunk, std::uint32_t& id) {
  if (chunk.base == ChunkBase::kAbsolute) return post(chunk, id);
  typename Space::Point base;
  if (!history_.find(chunk.observed_s, chunk.base == ChunkBase::kMeasured, base))
    return {Status::kReferenceTime, -1, -1, chunk.observed_s, 0.0};
  resolved_ = chunk;
  for (int i = 0; i < chunk.count && i < kChunkTargets; ++i) {
    typename Space::Point& target = resolved_.targets[static_cast<std::size_t>(i)];
    target = resolved(base, target);
  }
  return post(resolved_, id);
}

template <class Space>
Verdict ReferenceClient<Space>::post(const Chunk<Space>& chunk, std::uint32_t& id) {
  Verdict verdict = judge_chunk(chunk, channel_.settings);
  if (!verdict.ok()) return verdict;
  for (std::size_t i = 0; i < channel_.chunks.size(); ++i) {
    ChunkCurve<Space>& curve = channel_.chunks[i];
    if (!curve.free.load(std::memory_order_acquire)) continue;
    fit_chunk(chunk, channel_.settings, curve);
    curve.free.store(false, std::memory_order_relaxed);
    Request<Space> request;
    request.kind = RequestKind::kChunk;
    request.store = static_cast<int>(i);
    verdict = post(request, id);
    if (!verdict.ok()) curve.free.store(true, std::memory_order_relaxed);
    return verdict;
  }
  return {Status::kNoFreeStore};
}

template <class Space>
Verdict ReferenceClient<Space>::send(const Velocity<Space>& velocity, std::uint32_t& id,
                                     const typename Space::Header& header) {
  for (int i = 0; i < velocity.rates.size(); ++i)
    if (!std::isfinite(velocity.rates[i]))
      return {Status::kReferenceNotFinite, -1, i, velocity.rates[i], 0.0};
  const Verdict verdict = judge_velocity<Space>(velocity.rates, channel_.settings.limits);
  if (!verdict.ok()) return verdict;
  const auto share = [](double value) { return value > 0.0 && value <= 1.0; };
  if (!share(velocity.acceleration)) return {Status::kBadValue, -1, -1, velocity.acceleration, 1.0};
  if (!share(velocity.jerk)) return {Status::kBadValue, -1, -1, velocity.jerk, 1.0};
  if (!(velocity.timeout_s > 0.0 && std::isfinite(velocity.timeout_s)))
    return {Status::kReferenceTime, -1, -1, velocity.timeout_s, 0.0};
  Request<Space> request;
  request.kind = RequestKind::kVelocity;
  request.velocity = velocity;
  request.header = header;
  return post(request, id);
}

template <class Space>
const StreamState& ReferenceClient<Space>::stream() const {
  return channel_.stream;
}

#define TACTUS_REFERENCE_STREAMS(Space)                                                 \
  template const StreamState& ReferenceClient<Space>::stream() const;                   \
  template Verdict ReferenceClient<Space>::send(const Chunk<Space>&, std::uint32_t&);   \
  template Verdict ReferenceClient<Space>::send(const Velocity<Space>&, std::uint32_t&, \
                                                const Space::Header&)
TACTUS_REFERENCE_STREAMS(JointSpace);
TACTUS_REFERENCE_STREAMS(TaskSpace);
#undef TACTUS_REFERENCE_STREAMS

}  // namespace tactus
#endif
