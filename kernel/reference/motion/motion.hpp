// Motion: moves the reference, through its phases and without steps between them. It is independent
// of messages.
//
// The reference is a base plus an offset. The base is a path, passed at the rate of its law, a
// stream of points, the curves of chunks, or a point that is held. The offset is the difference of
// the reference from a new base at its beginning; the state-to-state law takes it to zero
// (offset_law.hpp), and then the reference equals the base bit by bit. The difference in
// feed-forward fades out.
//
// On a board with streams, kernel/streams completes it: what moves the base in the phases of
// streams, and the members that begin them.
#pragma once

#include <array>

#include "kernel/core/streams.hpp"
#include "kernel/reference/motion/motion_phase.hpp"
#include "kernel/reference/motion/path.hpp"
#include "kernel/reference/motion/path_law.hpp"
#include "kernel/reference/motion/path_progress.hpp"
#include "kernel/reference/motion/point_stream.hpp"

namespace tactus {

// Defined in kernel/streams.
template <class Space>
struct ChunkCurve;
template <class Space>
class ChunkPlan;
template <class Space>
struct MotionStreams;
template <class Space>
struct Velocity;
struct PassedOutputs;

template <class Space>
class Motion {
 public:
  using Point = typename Space::Point;
  using Settings = AdmissionSettings<Space>;

  /// Holds the position of `point` at rest. `settings` must outlive the motion. [init]
  [[gnu::cold]] void start(const Point& point, const Settings& settings);
  /// After start(): points and chunks of a new motion are approached at no more than `speed`,
  /// rad/s, for a tip m/s and rad/s; 0: the limit. [init]
  [[gnu::cold]] void approach_at(double speed);
  /// Moves the reference one period ahead. [cyclic]
  void move_on(double dt_s);

  /// Makes `point` the reference as it is, except for a quaternion's sign, and holds it. Leaves at
  /// once what it followed. [cyclic]
  void forward(const Point& point);
  /// Goes to `point` within limits, or along with the stream that it belongs to. Leaves at once
  /// what it followed, but brakes on a path until a stop stays inside position limits. [cyclic]
  void reach(const Point& point, double stamp_s);
  /// Leaves what it follows for a trajectory that began `elapsed_s` ago: by one segment to its
  /// first waypoint if that is still ahead, else at the point where its path is now. Refuses, with
  /// no effect, if the placed trajectory or that segment breaks a limit, if a path that begins now
  /// is near neither the reference nor the measured point, or on a path that cannot be left.
  /// [cyclic]
  Verdict follow(const Trajectory<Space>& trajectory, const typename Space::Tolerance& tolerance,
                 const Point& measured, double elapsed_s = 0.0);
  /// Goes along with the curve of `chunk`, whose clock shows `now_s`, from its first stamp ahead;
  /// until then with the chunks before. Refuses on a path that cannot be left. The chunk is
  /// released as soon as it is no longer needed. [cyclic]
  Verdict track(ChunkCurve<Space>& chunk, double now_s);
  /// Moves at a velocity, short of the position limits, and comes to rest when its time is over.
  /// Refuses on a path that cannot be left. [cyclic]
  Verdict drive(const Velocity<Space>& velocity);
  /// Passes paths at `rate`, 0..1, from now on; changes to it as fast as limits allow. [cyclic]
  void set_rate(double rate) { rate_ = rate; }
  /// Brings paths to rest (`on`) or continues them; a pause holds for later trajectories too.
  /// [cyclic]
  void pause(bool on);
  /// Comes to rest on the path and leaves it there. Without a path, or with an offset from it, acts
  /// as stop(). [cyclic]
  void cancel();
  /// Leaves what it follows and comes to rest the fastest way, wherever that ends. [cyclic]
  void stop();
  /// As stop(), but as cancel() if a stop would leave position limits. [cyclic]
  void stop_inside() { can_leave() ? stop() : cancel(); }
  /// Forgets the points of a stream: the next one begins a new stream. [cyclic]
  void forget_points() { stream_.clear(); }
  /// Ends a trajectory: the robot has arrived. [cyclic]
  void complete() { handle(MotionEvent::kComplete); }

  /// Takes up a longer part of the open trajectory it follows; refuses as Path::extend(). [cyclic]
  Verdict extend(const typename Space::Extent& more) { return path_.extend(more, *settings_); }

  const Point& reference() const { return reference_; }
  MotionPhase phase() const { return phase_; }
  bool started() const { return settings_ != nullptr; }
  /// True if the feed-forward of a held point is sent.
  bool holds_effort() const { return phase_ == MotionPhase::kHolding && !held_.idle(); }
  /// True if the motion still reads the waypoints of a trajectory.
  bool on_path() const { return tactus::on_path(phase_); }
  /// True if the path has ended and the reference is at rest at its end.
  bool at_goal() const { return phase_ == MotionPhase::kSettling && offset_.zero(); }
  /// True if braking on the path took longer than kLongestBrake_s, so that it was left.
  bool lost_path() const { return lost_path_; }
  /// Index of the first waypoint that is still needed.
  int needed() const { return path_.needed(); }
  /// Place on the path that it follows, or has followed to its end, and that end.
  PathProgress progress() const { return {law_.s(), path_.running() ? path_.end_s() : law_.s()}; }
  /// True if a stream moved the reference and has gone silent.
  bool silent() const { return phase_ == MotionPhase::kReaching && stream_.silent(time_s_); }
  bool gives_velocity() const { return stream_.gives_velocity(); }
  /// The chunks it goes along with; none outside the phases tracking and expiring.
  const ChunkPlan<Space>& plan() const;
  /// Hands over the digital outputs of the targets that were passed last. [cyclic]
  std::array<PassedOutputs, 2> take_outputs();
  /// Difference of the reference from its base, due to limits.
  const typename Space::Difference& offset() const { return offset_; }
  /// True if no successor of the last chunk or velocity has arrived in time.
  bool expires() const;
  /// Time for which the last chunk or the velocity still lasts; 0: none runs, or it stops.
  double margin_s() const;

 private:
  /// Feed-forward fades out in this time, or in the period of a stream.
  static constexpr double kFade_s = 0.1;

  void handle(MotionEvent event) {
    phase_ = next(phase_, event);
    if constexpr (kStreams) {
      if (!streams(phase_)) streams_.plan.clear();
    }
  }
  bool streaming() const { return phase_ == MotionPhase::kReaching && stream_.moves(time_s_); }
  bool steps() const { return on_path() && !path_.smooth(); }
  bool given_up() const {
    return phase_ == MotionPhase::kBraking || phase_ == MotionPhase::kLeaving;
  }
  bool can_leave() const;
  void begin_stream(MotionEvent event);
  const typename Space::Limits& limits_to(const Point& base);
  void move_stream(double dt_s);
  void rest_from_stream();
  void move_at_velocity(double dt_s);
  void leave_given_up();
  void go();
  Point base_of_points(double time_s) const;
  Point base_of_path(double dt_s);
  Point end_path(const Point& last);
  void arrive(MotionPhase was);
  void hold(const Point& point);
  void feed_beyond(const Point& fed, const Point& base, double fade_s);
  void fade(double dt_s);
  Verdict enter(Path<Space>& path, const typename Space::Tolerance& tolerance,
                const Point& measured, double elapsed_s, Point& base) const;

  const Settings* settings_ = nullptr;
  double time_s_ = 0.0;  // since the start
  MotionPhase phase_ = MotionPhase::kHolding;
  Point reference_;  // in this cycle

  Point base_;        // in this cycle
  Point held_;        // the base where nothing moves it
  Path<Space> path_;  // the base on a path
  PathLaw<Space> law_;
  double rate_ = 1.0;
  bool paused_ = false, lost_path_ = false;
  double braking_s_ = 0.0;
  PointStream<Space> stream_;  // the base while points are streamed
  OnlyWithStreams<MotionStreams<Space>> streams_;

  typename Space::Difference offset_;
  typename Space::Effort effort_;  // feed-forward that fades out
  double fade_s_ = 0.0, faded_s_ = 0.0;
};

}  // namespace tactus
