// Motion: moves the reference, through its phases and without steps between them. It knows nothing
// of messages.
//
// The reference is a base plus an offset. The base is a path, passed at the rate of its law, a
// stream of points, or a point that is held. The offset is the difference of the reference from a
// new base at its beginning; the state-to-state law takes it to zero (offset_law.hpp), and then the
// reference equals the base bit by bit. The difference in feed-forward fades out.
#pragma once

#include "kernel/reference/motion/motion_phase.hpp"
#include "kernel/reference/motion/path.hpp"
#include "kernel/reference/motion/path_law.hpp"
#include "kernel/reference/motion/point_stream.hpp"

namespace tactus {

template <class Space>
class Motion {
 public:
  using Point = typename Space::Point;
  using Settings = AdmissionSettings<Space>;

  /// Holds the position of `point` at rest. `settings` must outlive the motion. [init]
  [[gnu::cold]] void start(const Point& point, const Settings& settings);
  /// Moves the reference one period ahead. [cyclic]
  void move_on(double dt_s);

  /// Makes `point` the reference as it is, except for a quaternion's sign, and holds it. Leaves at
  /// once what it followed. [cyclic]
  void forward(const Point& point);
  /// Goes to `point` within limits, or along with the stream that it belongs to. Leaves at once
  /// what it followed, but brakes on a path until a stop stays inside position limits. [cyclic]
  void reach(const Point& point);
  /// Leaves what it follows for a trajectory that began `elapsed_s` ago: by one segment to its
  /// first waypoint if that is still ahead, else at the point where its path is now. Refuses, with
  /// no effect, if the placed trajectory or that segment breaks a limit, or if a path that begins
  /// now is near neither the reference nor the measured point. [cyclic]
  Verdict follow(const Trajectory<Space>& trajectory, const typename Space::Tolerance& tolerance,
                 const Point& measured, double elapsed_s = 0.0);
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
  /// Ends a trajectory: the robot has arrived. [cyclic]
  void complete() { tell(MotionEvent::kComplete); }

  /// Takes up a longer part of the open trajectory it follows; refuses as Path::extend(). [cyclic]
  Verdict extend(const typename Space::Extent& more) { return path_.extend(more, *settings_); }

  const Point& reference() const { return reference_; }
  Phase phase() const { return phase_; }
  bool started() const { return settings_ != nullptr; }
  /// True if a point is held whose feed-forward is put out.
  bool holds_effort() const { return phase_ == Phase::kHolding && !held_.idle(); }
  /// True if the motion still reads the waypoints of a trajectory.
  bool on_path() const { return tactus::on_path(phase_); }
  /// True if braking on the path took longer than kLongestBrake_s, so that it was left.
  bool lost_path() const { return lost_path_; }
  /// Index of the first waypoint that is still needed.
  int needed() const { return path_.needed(); }
  /// True if a stream moved the reference and has gone silent.
  bool silent() const { return phase_ == Phase::kReaching && stream_.silent(time_s_); }
  bool gives_velocity() const { return stream_.gives_velocity(); }

 private:
  void tell(MotionEvent event) { phase_ = next(phase_, event); }
  bool streaming() const { return phase_ == Phase::kReaching && stream_.moves(time_s_); }
  bool steps() const { return on_path() && !path_.smooth(); }
  bool given_up() const { return phase_ == Phase::kBraking || phase_ == Phase::kLeaving; }
  bool can_leave() const;
  void leave_given_up();
  void go();
  Point base_of_points(double time_s) const;
  Point base_of_path(double dt_s);
  Point end_path(const Point& last);
  void arrive(Phase was);
  void hold(const Point& point);
  void feed_beyond(const Point& fed, const Point& base, double fade_s);
  void fade(double dt_s);
  Verdict enter(Path<Space>& path, const typename Space::Tolerance& tolerance,
                const Point& measured, double elapsed_s, Point& base) const;

  const Settings* settings_ = nullptr;
  double time_s_ = 0.0;  // since the start
  Phase phase_ = Phase::kHolding;
  Point reference_;  // in this cycle

  Point base_;        // in this cycle
  Point held_;        // the base where nothing moves it
  Path<Space> path_;  // the base on a path
  PathLaw<Space> law_;
  double rate_ = 1.0;
  bool paused_ = false, lost_path_ = false;
  double braking_s_ = 0.0;
  PointStream<Space> stream_;  // the base while points are streamed

  typename Space::Difference offset_;
  typename Space::Effort effort_;  // feed-forward that fades out
  double fade_s_ = 0.0, faded_s_ = 0.0;
};

}  // namespace tactus
