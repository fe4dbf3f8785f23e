// ReferenceClient: the planner's end of a reference channel. Judges before it sends, and knows
// which stores are its own. Runs outside the cycle; one client per channel.
#pragma once

#include <array>

#include "kernel/reference/admission.hpp"
#include "kernel/reference/admission_room.hpp"

namespace tactus {

template <class Space>
class ReferenceClient {
 public:
  explicit ReferenceClient(ReferenceChannel<Space>& channel) : channel_(channel) {}

  /// A store to fill with waypoints, or null while all are on their way. Yours until sent.
  Trajectory<Space>* acquire();

  /// What `send` would say of a trajectory, but for the way from the robot to its first waypoint.
  Verdict judge(Trajectory<Space>& trajectory) const;
  /// Admits and sends an acquired trajectory; `id` comes back in its reports. When refused the
  /// store stays yours.
  Verdict send(Trajectory<Space>& trajectory, std::uint32_t& id);
  /// Judges one more waypoint of an open trajectory that was sent and puts it behind the others.
  /// kWindowFull while the motion still needs all that are there; the trajectory is then unchanged.
  Verdict append(const Trajectory<Space>& trajectory, const Waypoint<Space>& waypoint);
  /// Tells the generator of what was appended; after the `last` no more can be. Refused as a whole
  /// if it must be slowed down too much: then what was appended is gone. The motion counts on it as
  /// soon as the generator has taken it and this client is called again, by poll() too.
  Verdict flush(const Trajectory<Space>& trajectory, bool last, std::uint32_t& id);
  /// Admits and sends one online point, given in `terms`.
  Verdict send(const typename Space::Point& point, std::uint32_t& id,
               const typename Space::Terms& terms = {});
  /// Asks for the running trajectory to be stopped on its path and given up.
  Verdict cancel(std::uint32_t& id) { return ask(RequestKind::kCancel, id); }

  /// Trajectories pass at `rate`, 0..1, of their speed from now on.
  Verdict set_override(double rate, std::uint32_t& id);
  /// Stops on the path and keeps the trajectory alive; goes on with it.
  Verdict pause(std::uint32_t& id) { return ask(RequestKind::kPause, id); }
  Verdict resume(std::uint32_t& id) { return ask(RequestKind::kResume, id); }

  /// The next report, if there is one. A report that gives a store back frees it.
  bool poll(Report& report);
  /// The oldest message of feedback that waits, if there is one.
  bool poll_feedback(Feedback<Space>& feedback) { return channel_.feedback.take(feedback); }

 private:
  /// The client's own account of an open trajectory, whose count is the generator's once it is
  /// sent.
  struct Stream {
    int count = 0, flushed = 0, settled = 0;  // waypoints: all, sent, and their rooms set
    bool whole = false;                       // and none will follow
    Admitted<Space> admitted;                 // up to the last; use and room: of what is not sent
    Admitted<Space> sent;                     // up to the last that was
  };

  std::size_t index_of(const Trajectory<Space>& trajectory) const {
    return static_cast<std::size_t>(&trajectory - channel_.stores.data());
  }
  void settle(std::size_t store);
  Verdict ask(RequestKind kind, std::uint32_t& id);
  Verdict post(Request<Space> request, std::uint32_t& id);

  ReferenceChannel<Space>& channel_;
  std::array<bool, kStores> away_{};  // sent and not yet reported final
  std::array<Stream, kStores> streams_{};
  std::uint32_t next_id_ = 1;
};

}  // namespace tactus
