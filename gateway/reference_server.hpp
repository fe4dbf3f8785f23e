// ReferenceServer: sends a generator the references that come over a link in messages, as a client
// that is elsewhere would, judges them, and keeps the reports until they are asked for. A
// trajectory of any length passes through the window of its store. Runs outside the cycle.
#pragma once

#include "gateway/reference_client.hpp"
#include "gateway/reference_frames.hpp"
#include "kernel/pipeline/port_table.hpp"

namespace tactus {

template <class Space>
class ReferenceServer {
 public:
  /// `ports` has the frames that references name. [init]
  ReferenceServer(ReferenceChannel<Space>& channel, const PortTable& ports)
      : client_(channel), ports_(ports) {}

  /// Begins a trajectory; its waypoints follow. What was begun before and not ended is forgotten.
  Verdict begin(const TrajectoryTerms& terms);
  /// Takes waypoints as long as the window has space; `taken` says how many. The first that do not
  /// fit into the store send it, open.
  Verdict take(ByteReader& waypoints, int count, int& taken);
  /// Ends the trajectory; kWindowFull: the generator has not yet answered the last part, ask again.
  /// `id` is that of the trajectory.
  Verdict end(std::uint32_t& id);
  /// Sends a point whose numbers stand behind its terms.
  Verdict point(const TrajectoryTerms& terms, ByteReader& numbers, std::uint32_t& id);
  Verdict control(ControlKind kind, double rate, std::uint32_t& id);

  /// Fetches what the generator has reported; true: there was something.
  bool poll();
  /// Reports that wait.
  int waiting() const { return count_; }
  /// The oldest of them; there is one.
  Report next();

 private:
  static constexpr int kParts = 4;  // in a window
  static constexpr int kKept = 32;  // reports

  Verdict place(const TrajectoryTerms& terms, typename Space::Header& header) const;
  Verdict send_open();
  Verdict append(const Waypoint<Space>& waypoint);
  Verdict flush(bool last);

  ReferenceClient<Space> client_;
  const PortTable& ports_;
  Trajectory<Space>* trajectory_ = nullptr;  // that comes; null: none
  bool sent_ = false;                        // it is longer than its store, which was sent
  int part_ = 0;                             // waypoints appended since the last flush
  std::uint32_t id_ = 0, awaited_ = 0;       // of the trajectory, and of its last part
  Verdict failed_;                           // why a part was refused
  std::array<Report, kKept> reports_;
  int first_ = 0, count_ = 0;
};

}  // namespace tactus
