// Motion: where the reference goes. Nothing of messages here, only of continuity.
//
// The reference is the sum of a base and a bridge. The base is a path, run through at the rate of a
// time law, or a point that is held. The bridge is a quintic that takes the difference between
// where the reference was and where its new base begins to zero. Stop, pause, resume and override
// are rates of the one time law, so they never leave the path.
#pragma once

#include "kernel/reference/path_law.hpp"

namespace tactus {

template <class Space>
class Motion {
 public:
  using Point = typename Space::Point;
  using Bridge = typename Space::Bridge;
  using Settings = AdmissionSettings<Space>;

  /// Holds `point`, at rest; moves by `settings`, which must outlive the motion. [init]
  void start(const Point& point, const Settings& settings);
  /// One period further: along the path, or at rest where it was. [cyclic]
  void move_on(double dt_s);

  /// Puts out `point` as it is and holds it; the path is left at once. [cyclic]
  void forward(const Point& point);
  /// Goes to `point` within limits and holds it; the path is left at once. Refused, and nothing
  /// changes, if a limit of position is in the way. [cyclic]
  Verdict shape(const Point& point);
  /// Leaves whatever it follows for a trajectory that began `elapsed_s` ago: by one segment to its
  /// first waypoint if that lies ahead; by a bridge to it if that is now; else by one segment to
  /// the first waypoint that is as far ahead as such a bridge would take. Refused, and nothing
  /// changes, if a limit is in the way or a waypoint that is now is not near. [cyclic]
  Verdict follow(const Trajectory<Space>& trajectory, const typename Space::Tolerance& tolerance,
                 double elapsed_s = 0.0);
  /// From now on the path is passed at `rate`, 0..1, reached as fast as limits allow. [cyclic]
  void set_rate(double rate);
  /// The open trajectory it follows has become longer; refused as by Path::extend. [cyclic]
  Verdict extend(const typename Space::Use& more);
  /// Stops on the path, then leaves it. [cyclic]
  void brake();

  const Point& reference() const { return reference_; }
  /// A trajectory is still read. False once its end is reached or a brake has come to rest.
  bool on_path() const { return path_.running(); }
  /// An open trajectory has run out of waypoints: the arm stops, or stands, on the path.
  bool starving() const { return starving_; }
  /// First waypoint it still needs.
  int needed() const { return path_.needed(); }
  /// The reference does not move, and will not unless told to.
  bool standing() const { return !bridging_ && (!on_path() || law_.standing()); }

 private:
  void follow_path(double dt_s);
  Point base();
  Verdict meet(Path<Space>& path, const typename Space::Tolerance& tolerance,
               double elapsed_s) const;
  Verdict catch_up(Path<Space>& path, double elapsed_s) const;
  void leave_path();
  Bridge bridge_to(const Point& begin, double share) const;
  void start_bridge(const Bridge& bridge);
  typename Space::Peaks path_limits() const;

  const Settings* settings_ = nullptr;
  Point reference_;   // put out in this cycle
  Point held_;        // the base off the path
  Path<Space> path_;  // the base on it
  PathLaw<Space> law_;
  double rate_ = 1.0;  // wanted, and taken up again after starving
  bool braking_ = false, starving_ = false;

  Bridge bridge_;
  double bridge_time_s_ = 0.0;
  bool bridging_ = false;
};

}  // namespace tactus
