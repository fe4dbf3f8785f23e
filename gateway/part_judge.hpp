// PartJudge: judges a trajectory that is longer than its window without sending it, part by part as
// it is judged when its parts are sent. Every waypoint overwrites one of the window.
#pragma once

#include "gateway/part_sender.hpp"

namespace tactus {

template <class Space>
class PartJudge {
 public:
  using Settings = AdmissionSettings<Space>;

  /// Judges the waypoints in the window: all, or of an open trajectory the first. [any, not cyclic]
  Verdict begin(Trajectory<Space>& window, const Settings& settings) {
    Admitted<Space> admitted;
    const Verdict verdict = admit(window, settings, admitted);
    if (!verdict.ok()) return verdict;
    first_s_ = window.time_s(0);
    end_s_ = window.end_s();
    longer_s_ = window.stretch * (end_s_ - first_s_);
    account_.begin(window.count, admitted);
    return {};
  }
  /// Judges the next waypoint, and with it the part that it completes. [any, not cyclic]
  Verdict append(const Trajectory<Space>& window, const Waypoint<Space>& waypoint,
                 const Settings& settings) {
    const Verdict verdict = account_.append(window, waypoint, settings);
    const bool full = account_.count() - account_.ended() >= PartSender<Space>::part_size(window);
    return verdict.ok() && full ? judge_part(window, false, settings) : verdict;
  }
  /// Judges the last part: no more waypoints follow. [any, not cyclic]
  Verdict end(const Trajectory<Space>& window, const Settings& settings) {
    return judge_part(window, true, settings);
  }

  int next() const { return account_.count(); }   ///< number of the next waypoint
  int count() const { return account_.ended(); }  ///< waypoints of the parts that were judged
  double end_s() const { return end_s_; }         ///< time of the last of them
  double longer_s() const { return longer_s_; }   ///< time by which they are slowed down
  /// The same as a fraction of the time from the first waypoint to `end_s`.
  double stretch(double end_s) const {
    return longer_s_ > 0.0 ? longer_s_ / (end_s - first_s_) : 0.0;
  }

 private:
  Verdict judge_part(const Trajectory<Space>& window, bool last, const Settings& settings) {
    double longer = 0.0;
    const Verdict verdict = account_.judge_part(window, last, settings, longer);
    if (!verdict.ok()) return verdict;
    end_s_ = window.time_s(account_.count() - 1);
    longer_s_ += longer * (end_s_ - window.time_s(account_.ended() - 1));
    account_.end_part();
    return {};
  }

  PartAccount<Space> account_;
  double first_s_ = 0.0, end_s_ = 0.0, longer_s_ = 0.0;
};

}  // namespace tactus
