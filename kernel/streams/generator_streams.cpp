#include "kernel/streams/generator_streams.hpp"

#include <cassert>

#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/generator/reference_generator_members.hpp"
#include "kernel/reference/generator/reference_requests_members.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/judge_channels.hpp"
#include "kernel/reference/space/task_space.hpp"

#if TACTUS_CHUNK_TARGETS > 0
namespace tactus {
namespace {

/// Returns how many targets have a time up to `now_s`.
template <class Space>
int targets_until(const ChunkCurve<Space>& chunk, double now_s) {
  int passed = 0;
  LoopBound<1 << 8> targets;
  while (passed < chunk.count && chunk.knots[static_cast<std::size_t>(passed)].time_s <= now_s) {
    targets.tick();
    ++passed;
  }
  return passed;
}

}  // namespace

/// Asks for the digital outputs of the targets that were passed in this cycle.
template <class Space>
void ReferenceGenerator<Space>::pass_outputs() {
  for (const PassedOutputs& passed : motion_.take_outputs())
    if (passed.any) stream_.outputs.request(passed.outputs, time_s() + passed.delay_s);
}

/// Voids the epoch of a request that is refused or canceled regardless of its contents, and
/// releases its chunk.
template <class Space>
void ReferenceGenerator<Space>::void_request(const Request<Space>& request) {
  if (request.kind == RequestKind::kVelocity) stream_.gate.end(request.velocity.epoch);
  if (request.kind != RequestKind::kChunk) return;
  ChunkCurve<Space>& chunk = channel_->chunks[static_cast<std::size_t>(request.store)];
  stream_.gate.end(chunk.epoch);
  channel_->stream.epoch = stream_.gate.least();
  chunk.release();
}

/// Takes a chunk or a velocity. One ends the requests of this cycle.
template <class Space>
void ReferenceGenerator<Space>::take_stream(const Request<Space>& request) {
  assert(refusing_ == Status::kOk);
  begun_ = true;
  if (request.kind == RequestKind::kVelocity) return take_velocity(request);
  take_chunk(request);
}

/// True if the request is newer than all before; else answers it.
template <class Space>
bool ReferenceGenerator<Space>::in_order(const Request<Space>& request, std::uint32_t epoch,
                                         std::uint32_t sequence) {
  const EpochGate::Order order = stream_.gate.take(epoch, sequence);
  channel_->stream.epoch = stream_.gate.least();
  if (order == EpochGate::Order::kNext) return true;
  ++channel_->stream.dropped;
  if (order == EpochGate::Order::kOld)
    report(request.id, Outcome::kSuperseded);
  else
    report(request.id, Outcome::kRefused, -1, {Status::kEpochVoid});
  return false;
}

/// Judges the targets of a chunk with the present pose of their frames, which the client cannot
/// judge; sets `saturation` to that of the first target held at the end of a range, unless it is
/// set.
template <class Space>
Verdict ReferenceGenerator<Space>::judge_targets(const ChunkCurve<Space>& chunk,
                                                 Verdict& saturation) const {
  const typename Space::Limits& limits = channel_->settings.limits;
  const typename Space::Placement placement = Space::latch(chunk.header, reference(), limits);
  LoopBound<1 << 8> targets;
  for (int i = 0; i < chunk.count; ++i) {
    targets.tick();
    Point point = Space::placed(chunk.knots[static_cast<std::size_t>(i)].point, placement);
    const Verdict held = Space::saturate(point, limits);
    if (saturation.ok()) saturation = held;
    Verdict verdict = Space::judge_waypoint(point, limits);
    verdict.waypoint = i;
    if (!verdict.ok()) return verdict;
  }
  return {};
}

/// Puts a chunk in force from its first stamp ahead, which ends whatever ran before except older
/// chunks. One target is a point of a stream.
template <class Space>
void ReferenceGenerator<Space>::take_chunk(const Request<Space>& request) {
  ChunkCurve<Space>& chunk = channel_->chunks[static_cast<std::size_t>(request.store)];
  if (!in_order(request, chunk.epoch, chunk.sequence)) return chunk.release();
  if (chunk.count == 1) {
    Request<Space> point = request;
    point.point = chunk.knots[0].point;
    point.header = chunk.header;
    point.details = {{chunk.outputs[0], chunk.outputs_mask},
                     chunk.stamped ? chunk.first_s() : kNoStamp,
                     chunk.sender};
    chunk.release();
    return take_point(point);
  }
  Verdict saturation = chunk.saturation;  // the plan may release the chunk at once
  const int passed = targets_until(chunk, time_s());
  const bool late = passed == chunk.count;
  Verdict verdict;
  if (late)
    verdict = {Status::kChunkLate, -1, -1, time_s() - chunk.end_s(), 0.0};
  else if (!(chunk.first_s() <= time_s() + kLongestChunk_s))
    verdict = {Status::kReferenceTime, 0, -1, chunk.first_s(), time_s() + kLongestChunk_s};
  else
    verdict = judge_targets(chunk, saturation);
  if (verdict.ok()) verdict = motion_.track(chunk, time_s());
  if (!verdict.ok()) {
    if (late) ++channel_->stream.late;
    chunk.release();
    return report(request.id, Outcome::kRefused, -1, verdict);
  }
  channel_->stream.trimmed += static_cast<std::uint32_t>(passed);
  begin_stream(request.id, saturation);
}

template <class Space>
void ReferenceGenerator<Space>::take_velocity(const Request<Space>& request) {
  Velocity<Space> velocity = request.velocity;
  if (velocity.epoch != 0 && !in_order(request, velocity.epoch, velocity.sequence)) return;
  Point moving;
  Space::rates(moving) = velocity.rates;
  velocity.rates = Space::rates(
      Space::placed(moving, Space::latch(request.header, reference(), channel_->settings.limits)));
  const Verdict verdict = motion_.drive(velocity);
  if (!verdict.ok()) return report(request.id, Outcome::kRefused, -1, verdict);
  begin_stream(request.id);
}

template <class Space>
void ReferenceGenerator<Space>::begin_stream(std::uint32_t id, const Verdict& saturation) {
  end_running(Outcome::kAborted, true);
  point_age_s_ = -kInfinity;
  stream_.id = id;
  stream_.expired = false;
  report(id, Outcome::kExecuted, -1, note_saturation(saturation) ? saturation : Verdict());
}

/// Reports once that no successor of a chunk or velocity has arrived in time, and publishes the
/// counters for clients.
template <class Space>
void ReferenceGenerator<Space>::watch_expiry() {
  StreamState& state = channel_->stream;
  state.margin_s = static_cast<float>(motion_.margin_s());
  if (!streams(phase())) return;
  state.seam = static_cast<float>(motion_.plan().seam());
  state.offset = static_cast<float>(motion_.offset().x.cwiseAbs().maxCoeff());
  if (!motion_.offset().zero()) ++state.shaped;
  if (!motion_.expires() || stream_.expired) return;
  stream_.expired = true;
  ++state.starved;
  if (has_room()) report(stream_.id, Outcome::kStarved);
}

template class ReferenceGenerator<JointSpace>;
template class ReferenceGenerator<TaskSpace>;

}  // namespace tactus
#endif
