// PartSender: the waypoints of an open trajectory behind those that its window held when it was
// sent. They go in parts of a quarter of the window; the next part begins when the generator has
// answered the last one. Used by whoever feeds a window, from a file or from a link.
#pragma once

#include <algorithm>

#include "gateway/reference_client.hpp"

namespace tactus {

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

}  // namespace tactus
