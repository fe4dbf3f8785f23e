// PartAccount: the account of an open trajectory that grows by parts, which its client sends and
// the judge of a long file keeps: both admit the same waypoints for the same reasons.
#pragma once

#include "kernel/reference/motion/admission.hpp"

namespace tactus {

template <class Space>
class PartAccount {
 public:
  int count() const { return count_; }  ///< waypoints, those of the present part included
  int ended() const { return ended_; }  ///< waypoints of the parts that have ended
  const typename Space::Extent& extent() const { return admitted_.extent; }  ///< of this part

  /// Begins behind the waypoints of a trajectory that admit() has judged.
  void begin(int count, const Admitted<Space>& admitted) {
    count_ = count;
    admitted_ = admitted;
    end_part();
  }
  /// Writes one more waypoint into the window and judges it. [any, not cyclic]
  Verdict append(const Trajectory<Space>& trajectory, const Waypoint<Space>& waypoint,
                 const AdmissionSettings<Space>& settings) {
    trajectory.set(count_, waypoint);
    Verdict verdict = admit_time(trajectory, count_, waypoint.time_s, settings.period_s);
    if (verdict.ok()) verdict = admit_waypoint(trajectory, count_, settings, admitted_);
    count_ += verdict.ok() ? 1 : 0;
    return verdict;
  }
  /// Judges the present part as a whole, and its rest at the end if it is the last one; sets
  /// `longer` to the fraction by which it is slowed down. A part that is slowed down too much is
  /// dropped. [any, not cyclic]
  Verdict judge_part(const Trajectory<Space>& trajectory, bool last,
                     const AdmissionSettings<Space>& settings, double& longer) {
    Verdict verdict = last ? admit_end(trajectory, count_ - 1, settings, admitted_) : Verdict();
    if (!verdict.ok()) return verdict;
    verdict = admit_part(trajectory, ended_ - 1, count_ - 1, settings, admitted_, longer);
    if (verdict.ok()) return verdict;
    count_ = ended_;
    admitted_ = before_;
    return verdict;
  }
  /// Ends the present part. The next one continues its end; extent and room of that are empty.
  void end_part() {
    ended_ = count_;
    admitted_.extent = {};
    admitted_.room = 1.0;
    before_ = admitted_;
  }

 private:
  int count_ = 0, ended_ = 0;
  Admitted<Space> admitted_;  // up to the last waypoint; extent and room of the present part
  Admitted<Space> before_;    // up to the end of the last part
};

}  // namespace tactus
