// ReferenceServer: judges the references that arrive in messages over a link, sends them to a
// generator as a local client would, and keeps the reports until they are fetched. A
// trajectory of any length passes through the window of its store. Runs outside the cycle.
#pragma once

#include "gateway/open_trajectory.hpp"
#include "gateway/reference_frames.hpp"
#include "kernel/pipeline/port_table.hpp"

namespace tactus {

template <class Space>
class ReferenceServer {
 public:
  /// `ports` has the frames that references name. [init]
  ReferenceServer(ReferenceClient<Space>& client, const PortTable& ports)
      : client_(client), ports_(ports) {}

  /// Begins a trajectory; its waypoints follow. A trajectory begun before and not ended is dropped.
  Verdict begin(const TrajectoryTerms& terms);
  /// Takes the next waypoint; kWindowFull: there is no space at present, offer it again. The first
  /// that does not fit into the window sends the trajectory, open.
  Verdict take(const Waypoint<Space>& waypoint);
  /// Takes waypoints of a frame as long as the window has space; `taken` counts them.
  Verdict take(ByteReader& waypoints, int count, int& taken);
  /// Ends the trajectory; kWindowFull: the generator has not yet answered the last part; call
  /// again. `id` is that of the trajectory, 0 of one that is only judged.
  Verdict end(std::uint32_t& id);
  /// The number of the trajectory in transfer, once the generator has it; 0: not yet, or none.
  std::uint32_t sent() const { return trajectory_ != nullptr && sent_ ? id_ : 0; }
  /// Waypoints in the window of the trajectory in transfer; requires one.
  int capacity() const { return trajectory_->capacity; }
  /// How much longer the trajectory that was sent last becomes, as a fraction, as far as it was
  /// known then.
  double stretch() const { return stretch_; }
  /// Finds the joints that terms leave out, or their frames. kUnknownPort.
  Verdict place(const TrajectoryTerms& terms, typename Space::Header& header) const;
  /// Sends a point.
  Verdict point(const TrajectoryTerms& terms, const typename Space::Point& point, std::uint32_t& id,
                const PointDetails& details = {});
  /// Sends a point whose numbers are behind its terms in a frame.
  Verdict point(const TrajectoryTerms& terms, ByteReader& numbers, std::uint32_t& id);
  Verdict control(ControlKind kind, double rate, std::uint32_t& id);

  /// Takes the next report that is not the answer to a part; false: there is none.
  bool fetch(Report& report);
  /// Fetches what the generator has reported, to keep it; true: there was something.
  bool poll();
  /// Reports that wait.
  int waiting() const { return count_; }
  /// The oldest of them; there is one.
  Report next();

 private:
  static constexpr int kKept = 32;  // reports

  Verdict send_open();
  Verdict check(const Waypoint<Space>& waypoint);
  Verdict end_check();
  Verdict flush_full();

  ReferenceClient<Space>& client_;
  const PortTable& ports_;
  Trajectory<Space>* trajectory_ = nullptr;  // in transfer; null: none
  bool sent_ = false;                        // it is longer than its window, which was sent
  std::uint32_t id_ = 0;                     // of the trajectory
  double stretch_ = 0.0;
  bool checks_ = false;  // it is judged and not sent
  PartJudge<Space> judge_;
  PartSender<Space> parts_;
  std::array<Report, kKept> reports_;
  int first_ = 0, count_ = 0;
};

}  // namespace tactus
