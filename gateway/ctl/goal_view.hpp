// GoalView: the server's reports and feedback on one trajectory or point, as a progress line with
// the live tracking error, and its end.
#pragma once

#include "gateway/ctl/output.hpp"

namespace tactus::ctl {

/// The largest difference between desired and actual position: of a joint, or of the tip.
struct TrackingError {
  double joint_rad = 0.0;  ///< m of a prismatic joint
  int joint = 0;           ///< from 0
  double tip_m = 0.0, tip_rad = 0.0;

  std::string text(const Welcome& welcome) const;
};

class GoalView {
 public:
  GoalView(Output& output, const Welcome& welcome) : output_(output), welcome_(welcome) {}

  /// Time of the last waypoint; 0: not known.
  void set_length(double length_s) { length_s_ = length_s; }
  /// Follows the request of this number.
  void follow(std::uint32_t number) { number_ = number; }
  /// Takes what arrives, and shows it.
  void take(const ToClient& message);

  bool ended() const { return ended_; }
  bool moves() const { return started_ && !ended_; }
  /// True once a State after the end reports the reference at rest.
  bool at_rest() const { return at_rest_; }
  const Report& report() const { return report_; }
  const State& state() const { return state_; }
  /// Prints the result.
  void print() const;

 private:
  void take_report(const Report& report);
  void take_feedback(const Feedback& feedback);
  void take_state(const State& state);
  void show();

  Output& output_;
  const Welcome& welcome_;
  double length_s_ = 0.0;
  std::uint32_t number_ = 0;
  Report report_;
  bool started_ = false, ended_ = false, at_rest_ = false, starved_ = false;
  double start_s_ = 0.0, elapsed_s_ = 0.0;
  double passed_s_ = 0.0;  // in the times of the waypoints
  State state_;
  TrackingError now_, largest_;
};

}  // namespace tactus::ctl
