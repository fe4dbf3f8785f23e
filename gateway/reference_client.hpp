// ReferenceClient: the planner's end of a reference channel. Judges before it sends, and knows
// which stores are its own. Runs outside the cycle; one client per channel.
#pragma once

#include <array>

#include "kernel/reference/admission.hpp"

namespace tactus {

class ReferenceClient {
 public:
  explicit ReferenceClient(ReferenceChannel<JointSpace>& channel) : channel_(channel) {}

  /// A store to fill with waypoints, or null while all are on their way. Yours until sent.
  Trajectory<JointSpace>* acquire();

  /// What `send` would say of a trajectory, but for the way from the robot to its first waypoint.
  Verdict judge(const Trajectory<JointSpace>& trajectory) const;
  /// Admits and sends an acquired trajectory; `id` comes back in its reports. When refused the
  /// store stays yours.
  Verdict send(Trajectory<JointSpace>& trajectory, std::uint32_t& id);
  /// Admits and sends one online point.
  Verdict send(const JointSpace::Point& point, std::uint32_t& id);
  /// Asks for the running trajectory to be cancelled.
  Verdict cancel(std::uint32_t& id);

  /// The next report, if there is one. A final report of a trajectory frees its store.
  bool poll(Report& report);

 private:
  Verdict post(Request<JointSpace> request, std::uint32_t& id);

  ReferenceChannel<JointSpace>& channel_;
  std::array<bool, kStores> away_{};  // sent and not yet reported final
  std::uint32_t next_id_ = 1;
};

}  // namespace tactus
