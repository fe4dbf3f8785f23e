#include "kernel/streams/chunk_plan.hpp"

#include <algorithm>

#include "kernel/core/loop_bound.hpp"
#include "kernel/reference/motion/time_rounding.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"
#include "kernel/streams/fading_time.hpp"

#if TACTUS_CHUNK_TARGETS > 0
namespace tactus {
namespace {

/// A pause of the plan up to which it is bridged; before a longer one it comes to rest.
constexpr double kBridged_s = 0.25;

}  // namespace

template <class Space>
void ChunkPlan<Space>::install(ChunkCurve<Space>& chunk, const Placement& placement, double ahead_s,
                               double now_s) {
  Piece piece = {&chunk, placement, 0.0, ahead_s};
  const double first_s = piece.first_s();
  piece.start_s = std::max(first_s, now_s);
  LoopBound<kChunkStores> replaced;
  while (count_ > 0 && pieces_[count_ - 1].start_s >= piece.start_s) {
    replaced.tick();
    pieces_[--count_].chunk->release();
    if (count_ == 0) entered_ = false;
  }
  const bool idle = count_ == 0 || stops_;
  const double covered_s = idle ? now_s : std::max(now_s, pieces_[count_ - 1].end_s());
  if (first_s > covered_s) piece.start_s = idle ? now_s : std::max(covered_s, first_s - kBridged_s);
  pieces_[count_++] = piece;
}

template <class Space>
void ChunkPlan<Space>::clear() {
  LoopBound<kChunkStores> all;
  while (count_ > 0) {
    all.tick();
    pieces_[--count_].chunk->release();
  }
  entered_ = stops_ = bounded_ = false;
  passed_target_ = {};
}

template <class Space>
void ChunkPlan<Space>::drop_first() {
  now().chunk->release();
  --count_;
  LoopBound<kChunkStores> others;
  for (std::size_t i = 0; i < count_; ++i) {
    others.tick();
    pieces_[i] = pieces_[i + 1];
  }
}

template <class Space>
bool ChunkPlan<Space>::due(double now_s) const {
  const std::size_t next = entered_ ? 1 : 0;
  return count_ > next && pieces_[next].start_s <= now_s;
}

template <class Space>
typename Space::Point ChunkPlan<Space>::enter(double before_s, double now_s, const Point& reference,
                                              const Limits& limits, bool fades) {
  LoopBound<kChunkStores> begun;
  while (due(now_s)) {
    begun.tick();
    if (entered_) {
      pass_last_targets(now_s);
      drop_first();
    }
    entered_ = true;
  }
  stops_ = false;
  const double s = before_s - now().zero_s, lead_s = now().chunk->first_s() - s;
  target_ = -1;
  if (lead_s > now_s - before_s)
    join_from(s, reference, limits, fades);
  else
    follow(s);
  if (runs_out(now_s)) stop_path_time(before_s);
  const Point base = curve(path_time(before_s));
  const bool rests = count_ == 1 && now().chunk->ends;
  const double lasts_s = stops_ ? stop_.duration() : rests ? now().end_s() - before_s : kInfinity;
  fade_in(before_s, lasts_s, reference, base, limits, fades);
  return fade_s_ > 0.0 ? reference : base;
}

/// Leads to the first knot: from the reference by one quintic, if it `fades` and there is time;
/// else along the tangent of the curve.
template <class Space>
void ChunkPlan<Space>::join_from(double s, const Point& reference, const Limits& limits,
                                 bool fades) {
  const Point first = now().knot(0), origin = first.at_rest();
  const double lead_s = now().chunk->first_s() - s;
  Point from = Space::without_held(reference, now().placement);
  if (!fades || fading_time_s<Space>(Space::difference(from, first), limits,
                                     kTimeRounding_s + 0.05) > lead_s) {
    Difference back = Space::difference(first, origin);
    back.x -= lead_s * back.dx;
    back.ddx.setZero();
    from = Space::sum(origin, back);
  }
  target_ = 0;
  segment_s_ = s;
  segment_end_s_ = now().chunk->first_s();
  segment_ = Segment(from, first, lead_s, Interpolation::kQuintic, kVelocityField);
}

/// Makes the segment of path time s the present one; before the first knot, the first.
template <class Space>
void ChunkPlan<Space>::follow(double s) {
  target_ = knot_after(*now().chunk, s);
  const auto to = static_cast<std::size_t>(target_);
  const auto& knots = now().chunk->knots;
  segment_s_ = knots[to - 1].time_s;
  segment_end_s_ = knots[to].time_s;
  segment_ = Segment(now().knot(target_ - 1), now().knot(target_), segment_end_s_ - segment_s_,
                     Interpolation::kQuintic, kVelocityField);
}

/// Returns the first knot, from the second on, that is later than s; the last if there is none.
template <class Space>
int ChunkPlan<Space>::knot_after(const ChunkCurve<Space>& chunk, double s) {
  int before = 0, found = chunk.count - 1;
  LoopBound<8> halvings;  // of 256 knots
  while (found - before > 1) {
    halvings.tick();
    const int middle = before + (found - before) / 2;
    (chunk.knots[static_cast<std::size_t>(middle)].time_s > s ? found : before) = middle;
  }
  return found;
}

template <class Space>
bool ChunkPlan<Space>::runs_out(double now_s) const {
  if (!entered_ || stops_ || now().chunk->ends) return false;
  const bool succeeded = count_ > 1 && pieces_[1].start_s <= now().end_s() + kTimeRounding_s;
  return !succeeded && now_s - now().zero_s >= now().chunk->brake_s;
}

template <class Space>
typename Space::Point ChunkPlan<Space>::stop(double before_s, const Point& base,
                                             const Point& reference, const Limits& limits,
                                             bool fades) {
  const bool slower_at_once = stop_path_time(before_s);
  if (!slower_at_once && !diverges(before_s + stop_.duration())) return base;
  const Point slower = curve(path_time(before_s));
  fade_in(before_s, stop_.duration(), reference, slower, limits, fades);
  return fade_s_ > 0.0 ? reference : slower;
}

/// True if what is left of the disagreement at `time_s` would still grow: a base that rests by then
/// would go back.
template <class Space>
bool ChunkPlan<Space>::diverges(double time_s) const {
  const double x = time_s - jump_s_;
  if (!(x < fade_s_)) return false;
  const Difference left = faded(jump_, x / fade_s_, fade_s_);
  return left.x.dot(left.dx) > 0.0;
}

/// Stops path time at the end of the chunk. From full rate if there is still time for it, else from
/// a lower one: then returns true, as the base is no longer what it was.
template <class Space>
bool ChunkPlan<Space>::stop_path_time(double before_s) {
  const ChunkCurve<Space>& chunk = *now().chunk;
  const double s = before_s - now().zero_s, left_s = std::max(chunk.end_s() - s, 0.0);
  const double rate = std::min(left_s / chunk.brake_way_s, 1.0);
  stop_ = plan_to({s, rate, 0.0}, chunk.end_s(), 0.0,
                  {-1.0, 1.0, chunk.brake_a, chunk.brake_a, chunk.brake_j});
  stop_from_s_ = before_s;
  stops_ = true;
  return rate < 1.0;
}

template <class Space>
typename ChunkPlan<Space>::PathTime ChunkPlan<Space>::path_time(double now_s) const {
  const double end_s = now().chunk->end_s();
  if (!stops_) {
    const double s = now_s - now().zero_s;
    return s < end_s ? PathTime{s, 1.0, 0.0} : PathTime{end_s, 0.0, 0.0};
  }
  const AxisState state = stop_.at(now_s - stop_from_s_);
  return {std::min(state.p, end_s), std::max(state.v, 0.0), state.a};
}

template <class Space>
typename Space::Point ChunkPlan<Space>::curve(const PathTime& time) const {
  const double t = std::min(time.s - segment_s_, segment_.duration());
  return segment_.at(t).at_rate(time.rate, time.slope);
}

/// Fades the difference from the base, which moves for `lasts_s`. A fade that went on when the
/// curve has come to rest would take the reference back; in its place the base is the curve at
/// once.
template <class Space>
void ChunkPlan<Space>::fade_in(double before_s, double lasts_s, const Point& reference,
                               const Point& base, const Limits& limits, bool fades) {
  jump_ = Space::difference(reference, base);
  jump_s_ = before_s;
  seam_ = jump_.x.cwiseAbs().maxCoeff();
  fade_s_ = fades ? std::min(now().chunk->fade_s, lasts_s) : 0.0;
  const double least_s = fade_s_;
  if (fade_s_ > 0.0) fade_s_ = fading_time_s<Space>(jump_, limits, fade_s_);
  const bool strays = fade_s_ > least_s && fade_strays(reference, limits);
  if (fade_s_ > lasts_s || strays) fade_s_ = 0.0;
  bounded_ = fade_s_ == 0.0 && (lasts_s < kInfinity || strays);
  if (bounded_) bound(reference, limits);
}

/// True if the base, while the difference fades, would leave what the knots ahead and the way in
/// which the reference can stop span, and a little more. Looks at some of the knots.
template <class Space>
bool ChunkPlan<Space>::fade_strays(const Point& reference, const Limits& limits) const {
  constexpr int kLooks = 32;
  constexpr double kMore = 0.1, kLeast = 1e-3;
  constexpr double kFarthest = 1.0 / 3.0;  // of the time, of a difference of velocities
  using Way = decltype(jump_.x);
  const ChunkCurve<Space>& chunk = *now().chunk;
  const Way stop = Space::difference(Space::rest_of(reference, limits), reference).x;
  Way lowest = stop.cwiseMin(0.0), highest = stop.cwiseMax(0.0);
  Way least = Way::Zero(), most = Way::Zero();
  const int first = std::max(target_, 0), step = (chunk.count - first + kLooks - 1) / kLooks;
  LoopBound<kLooks> looks;
  for (int i = chunk.count - 1; i >= first; i -= step) {
    looks.tick();
    const Way way = Space::difference(now().knot(i), reference).x;
    lowest = lowest.cwiseMin(way);
    highest = highest.cwiseMax(way);
    const double after_s = now().zero_s + chunk.knots[static_cast<std::size_t>(i)].time_s - jump_s_;
    // The curve rests at its last knot while what is left goes farthest.
    const double x = std::max(after_s / fade_s_, i == chunk.count - 1 ? kFarthest : 0.0);
    if (!(x < 1.0)) continue;
    const Way base = way + faded(jump_, x, fade_s_).x;
    least = least.cwiseMin(base);
    most = most.cwiseMax(base);
  }
  const Way more = (kMore * (highest - lowest)).array() + kLeast;
  return !((least - lowest + more).minCoeff() >= 0.0 && (highest + more - most).minCoeff() >= 0.0);
}

/// Takes the places of the reference, of where it can stop and of the knots ahead, and a little
/// more than what they span.
template <class Space>
void ChunkPlan<Space>::bound(const Point& reference, const Limits& limits) {
  constexpr double kMore = 0.01, kLeast = 1e-6;
  const Point rest = Space::rest_of(reference, limits);
  lowest_ = Space::place(reference).cwiseMin(Space::place(rest));
  highest_ = Space::place(reference).cwiseMax(Space::place(rest));
  LoopBound<kChunkTargets> ahead;
  for (int i = std::max(target_, 0); i < now().chunk->count; ++i) {
    ahead.tick();
    const Point knot = now().knot(i);
    lowest_ = lowest_.cwiseMin(Space::place(knot));
    highest_ = highest_.cwiseMax(Space::place(knot));
  }
  const typename Space::Place more = (kMore * (highest_ - lowest_)).array() + kLeast;
  lowest_ -= more;
  highest_ += more;
}

template <class Space>
typename Space::Point ChunkPlan<Space>::move_on(double now_s) {
  const PathTime time = path_time(now_s);
  if (time.s >= segment_end_s_ && target_ < now().chunk->count - 1) follow(time.s);
  const Point point = curve(time);
  const double x = now_s - jump_s_;
  return x < fade_s_ ? Space::sum(point, faded(jump_, x / fade_s_, fade_s_)) : point;
}

template <class Space>
bool ChunkPlan<Space>::ended(double now_s) const {
  if (count_ != 1 || !entered_) return count_ == 0;
  return path_time(now_s).rate <= 0.0 && now_s - jump_s_ >= fade_s_;
}

template <class Space>
double ChunkPlan<Space>::margin_s(double now_s) const {
  if (count_ == 0 || stops_) return 0.0;
  const Piece& last = pieces_[count_ - 1];
  return last.chunk->ends ? kInfinity : last.zero_s + last.chunk->brake_s - now_s;
}

template class ChunkPlan<JointSpace>;
template class ChunkPlan<TaskSpace>;

}  // namespace tactus
#endif
