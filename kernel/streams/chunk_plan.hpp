// ChunkPlan: the plan that overlapping chunks make up. Each is in force from its first stamp that
// is still ahead until the next newer one begins.
//
//   base(t) = curve(s(t)) + what is left of the seam's disagreement
//
// The curve is a quintic between two knots. Path time s is the time, or, where no successor has
// come, the state-to-state law brings its rate to zero at the last knot, so that the base never
// turns back. At a seam, the difference of the commanded position, velocity and acceleration from
// those of the new curve fades by a quintic in the chunk's time, or in the longer one that keeps
// half of every limit free. One whose fade would stray from where the targets are, as it does from
// a curve that passes the seam faster than the limits allow, is no part of the base: the reference
// approaches the curve within the limits.
//
// Digital outputs of the targets keep time with path time: they stop where it stops.
#pragma once

#include "kernel/core/digital_outputs.hpp"
#include "kernel/reference/space/offset_law.hpp"
#include "kernel/reference/space/space.hpp"
#include "kernel/streams/chunk.hpp"

namespace tactus {

/// A target that was passed, and its digital outputs with the time after which they are due.
struct PassedTarget {
  std::uint32_t epoch = 0, sequence = 0;
  int target = -1;
  bool operator==(const PassedTarget& other) const {
    return epoch == other.epoch && sequence == other.sequence && target == other.target;
  }
};
struct PassedOutputs {
  bool any = false;  ///< a target with outputs was passed
  DigitalOutputs outputs;
  double delay_s = 0.0;
};

/// Outputs of the last target of a chunk that ends, and of its successor.
using PassedInPeriod = std::array<PassedOutputs, 2>;

template <class Space>
class ChunkPlan {
 public:
  using Point = typename Space::Point;
  using Limits = typename Space::Limits;
  using Placement = typename Space::Placement;

  /// Puts `chunk` in force from its first stamp that is ahead of `now_s`, the time of the plan. Its
  /// clock is `ahead_s` behind that of its stamps. Releases the chunks that it replaces whole. One
  /// that begins only after the end of the plan is led to. At least one stamp is ahead. [cyclic]
  void install(ChunkCurve<Space>& chunk, const Placement& placement, double ahead_s, double now_s);
  /// Releases all chunks. [cyclic]
  void clear();
  /// True if a chunk begins up to `now_s`. [cyclic]
  bool due(double now_s) const;
  /// Enters the newest chunk that is due at `now_s`, while the reference of `before_s` is sent;
  /// returns the base at `before_s`. Unless it `fades`, the base is the curve at once. [cyclic]
  Point enter(double before_s, double now_s, const Point& reference, const Limits& limits,
              bool fades);
  /// True if the chunk in force has no successor and the stop at its end is to begin before
  /// `now_s`. [cyclic]
  bool runs_out(double now_s) const;
  /// Begins that stop at `before_s`, while the reference is sent and the base is `base`; returns
  /// the base, which is another one if it is too late to stop from full rate. [cyclic]
  Point stop(double before_s, const Point& base, const Point& reference, const Limits& limits,
             bool fades);
  /// Moves path time to `now_s`, and returns the base. [cyclic]
  Point move_on(double now_s);
  /// Returns `own`, or, until the reference has joined a curve that comes to rest and is followed
  /// at once, limits that keep it between where it was and the rest of the curve, so that in its
  /// haste it does not pass the end. [cyclic]
  const Limits& beside(const Limits& own) {
    if (!bounded_) return own;
    narrow_ = Space::narrowed(own, lowest_, highest_);
    return narrow_;
  }
  /// The reference has joined the curve, which may leave the places of its knots. [cyclic]
  void join() { bounded_ = false; }
  /// Finds the digital outputs of the targets passed up to `now_s`. [cyclic]
  void pass_outputs(double now_s);
  /// Hands over what pass_outputs() has found since the last time. [cyclic]
  PassedInPeriod take_outputs() {
    const PassedInPeriod passed = passed_;
    passed_ = {};
    return passed;
  }

  /// True if the base rests at the end of the last chunk. [cyclic]
  bool ended(double now_s) const;
  /// True if no successor has arrived and the base is being stopped.
  bool stopping() const { return stops_; }
  /// Time until that stop begins; infinite for a chunk that ends at rest. [cyclic]
  double margin_s(double now_s) const;
  /// Largest component of the disagreement at the last seam, rad or m.
  double seam() const { return seam_; }

 private:
  using Difference = typename Space::Difference;
  using Segment = typename Space::Segment;

  /// A chunk in its placement, and by the clock of the plan: its beginning, and its time zero.
  struct Piece {
    ChunkCurve<Space>* chunk = nullptr;
    Placement placement;
    double start_s = 0.0, zero_s = 0.0;

    double first_s() const { return zero_s + chunk->first_s(); }
    double end_s() const { return zero_s + chunk->end_s(); }
    double outputs_begin_s() const { return std::max(start_s, first_s()); }
    Point knot(int i) const {
      return Space::placed(chunk->knots[static_cast<std::size_t>(i)].point, placement);
    }
  };
  /// Path time by the chunk's clock, its rate and the slope of the rate.
  struct PathTime {
    double s, rate, slope;
  };

  Piece& now() { return pieces_[0]; }
  const Piece& now() const { return pieces_[0]; }
  void drop_first();
  void pass_last_targets(double now_s);
  void pass_targets(std::size_t i, double now_s);
  void join_from(double s, const Point& reference, const Limits& limits, bool fades);
  void follow(double s);
  static int knot_after(const ChunkCurve<Space>& chunk, double s);
  bool stop_path_time(double before_s);
  bool diverges(double time_s) const;
  PathTime path_time(double now_s) const;
  Point curve(const PathTime& time) const;
  void bound(const Point& reference, const Limits& limits);
  bool fade_strays(const Point& reference, const Limits& limits) const;
  void fade_in(double before_s, double lasts_s, const Point& reference, const Point& base,
               const Limits& limits, bool fades);

  std::array<Piece, kChunkStores> pieces_;  // in the order of their beginnings
  std::size_t count_ = 0;
  bool entered_ = false;  // the first of them is in force

  Segment segment_;  // to knot `target_`
  int target_ = 0;
  double segment_s_ = 0.0, segment_end_s_ = 0.0;  // by the chunk's clock
  bool stops_ = false;
  double stop_from_s_ = 0.0;
  AxisPlan stop_;

  Difference jump_;  // at jump_s_, from the curve to the reference
  double jump_s_ = 0.0, fade_s_ = 0.0;
  double seam_ = 0.0;
  bool bounded_ = false;
  typename Space::Place lowest_, highest_;
  Limits narrow_;
  PassedTarget passed_target_;
  PassedInPeriod passed_;
};

}  // namespace tactus
