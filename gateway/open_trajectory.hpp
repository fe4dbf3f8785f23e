// The parts of an open trajectory: one that is longer than the window of its store and grows there
// part by part. A part is a quarter of the window.
#pragma once

#include <algorithm>

#include "gateway/reference_client.hpp"

namespace tactus {

/// Sends the waypoints of an open trajectory after those that its window held when it was sent. The
/// next part begins when the generator has answered the last one. Used for files and for links.
template <class Space>
class PartSender {
 public:
  /// Waypoints of a whole part.
  static int part_size(const Trajectory<Space>& window) {
    constexpr int kParts = 4;  // in a window
    return std::max(1, window.capacity / kParts);
  }

  /// Begins behind the `count` waypoints of a trajectory that is sent, or will be.
  void begin(int count) {
    appended_ = sent_ = count;
    awaited_ = 0;
    failed_ = {};
  }
  /// Appends a waypoint to the present part; kWindowFull while it has to wait. [any, not cyclic]
  Verdict append(ReferenceClient<Space>& client, const Trajectory<Space>& window,
                 const Waypoint<Space>& waypoint) {
    if (!failed_.ok()) return failed_;
    if (awaiting()) return {Status::kWindowFull};
    const Verdict verdict = client.append(window, waypoint);
    appended_ += verdict.ok() ? 1 : 0;
    return verdict;
  }
  /// True if the present part is whole and is to be sent.
  bool part_full(const Trajectory<Space>& window) const { return unsent() >= part_size(window); }
  /// Sends the present part. [any, not cyclic]
  Verdict flush(ReferenceClient<Space>& client, const Trajectory<Space>& window, bool last) {
    if (!failed_.ok()) return failed_;
    const Verdict verdict = client.flush(window, last, awaited_);
    if (verdict.ok()) sent_ = appended_;
    return verdict;
  }
  /// Takes a report; true if it was the answer to a part.
  bool answered(const Report& report) {
    if (awaited_ == 0 || report.id != awaited_) return false;
    awaited_ = 0;
    if (report.outcome == Outcome::kRefused) failed_ = report.verdict;
    return true;
  }

  bool awaiting() const { return awaited_ != 0; }    ///< a part is not answered yet
  const Verdict& failed() const { return failed_; }  ///< why a part was refused
  int appended() const { return appended_; }         ///< waypoints up to now
  int sent() const { return sent_; }                 ///< those of whole parts
  int unsent() const { return appended_ - sent_; }

 private:
  int appended_ = 0, sent_ = 0;
  std::uint32_t awaited_ = 0;  // number of the part that is not answered; 0: none
  Verdict failed_;
};

/// Judges a trajectory that is longer than its window without sending it, part by part as its parts
/// would be judged when sent. Every waypoint overwrites one of the window.
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
