// Motion: where the reference goes. Nothing of messages here, only of phases and continuity.
//
// The reference is a base and an offset from it. The base is a path, run along at the rate of its
// law, a stream of points, or a point that is held. The offset is what the reference was beside its
// base when that began; the state-to-state law takes it to zero (offset_law.hpp), from where the
// reference is the base, bit by bit. What a base fed forward beyond the next one fades.
#pragma once

#include "kernel/reference/motion_phase.hpp"
#include "kernel/reference/path.hpp"
#include "kernel/reference/path_law.hpp"
#include "kernel/reference/point_stream.hpp"

namespace tactus {

template <class Space>
class Motion {
 public:
  using Point = typename Space::Point;
  using Settings = AdmissionSettings<Space>;

  /// Holds `point`, at rest; moves by `settings`, which must outlive the motion. [init]
  void start(const Point& point, const Settings& settings);
  /// One period further. [cyclic]
  void move_on(double dt_s);

  /// Puts out `point` as it is and holds it; what it followed is left at once. [cyclic]
  void forward(const Point& point);
  /// Goes to `point` within limits, or along the stream that it belongs to; what it followed is
  /// left at once. [cyclic]
  void reach(const Point& point);
  /// Leaves whatever it follows for a trajectory that began `elapsed_s` ago: by one segment to its
  /// first waypoint if that lies ahead, else where its path is by now. Refused, and nothing
  /// changes, if that segment breaks a limit or a waypoint that is now is near neither the
  /// reference nor what is measured. [cyclic]
  Verdict follow(const Trajectory<Space>& trajectory, const typename Space::Tolerance& tolerance,
                 const Point& measured, double elapsed_s = 0.0);
  /// From now on paths are run at `rate`, 0..1, reached as fast as limits allow. [cyclic]
  void set_rate(double rate) { rate_ = rate; }
  /// Paths are brought to rest, and go on after it, those of later trajectories too. [cyclic]
  void pause(bool on);
  /// Comes to rest on its path, and leaves it there; beside a path or off it at once. [cyclic]
  void cancel();
  /// Leaves what it follows and comes to rest the fastest way, wherever that is. [cyclic]
  void stop();
  /// The robot is where it should be: nothing is followed any more. [cyclic]
  void complete() { tell(MotionEvent::kComplete); }

  /// The open trajectory it follows has become longer; refused as by Path::extend. [cyclic]
  Verdict extend(const typename Space::Use& more);

  const Point& reference() const { return reference_; }
  Phase phase() const { return phase_; }
  /// A trajectory is still read.
  bool on_path() const { return tactus::on_path(phase_); }
  /// The path could not be braked on in kLongestBrake_s, and was left.
  bool lost_path() const { return lost_path_; }
  /// First waypoint it still needs.
  int needed() const { return path_.needed(); }
  /// A stream moved the reference, and has gone silent.
  bool silent() const { return phase_ == Phase::kReaching && stream_.silent(time_s_); }
  bool gives_velocity() const { return stream_.gives_velocity(); }

 private:
  void tell(MotionEvent event) { phase_ = next(phase_, event); }
  bool streaming() const { return phase_ == Phase::kReaching && stream_.moves(time_s_); }
  bool steps() const { return on_path() && !path_.smooth(); }
  Point base_of_points(double time_s) const;
  Point base_of_path(double dt_s);
  Point end_path(const Point& last);
  void settle();
  void hold(const Point& point);
  void feed_beyond(const Point& fed, const Point& base, double fade_s);
  void fade(double dt_s);
  Verdict enter(Path<Space>& path, const typename Space::Tolerance& tolerance,
                const Point& measured, double elapsed_s) const;

  const Settings* settings_ = nullptr;
  double time_s_ = 0.0;  // since the start
  Phase phase_ = Phase::kHolding;
  Point reference_;  // put out in this cycle

  Point base_;        // in this cycle
  Point held_;        // the base where nothing moves it
  Path<Space> path_;  // the base on a path
  PathLaw<Space> law_;
  double rate_ = 1.0;
  bool paused_ = false, lost_path_ = false;
  double braking_s_ = 0.0;
  PointStream<Space> stream_;  // the base of points

  typename Space::Difference offset_;
  typename Space::Effort effort_;  // fed forward beyond the base's when that began
  double fade_s_ = 0.0, faded_s_ = 0.0;
};

}  // namespace tactus
