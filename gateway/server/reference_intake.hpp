// ReferenceIntake: the references of one space on their way from the clients to the generator, and
// its reports on their way back. It stages the waypoints of one trajectory at a time, grants its
// client credit for as many as it can take at any moment, and assigns every report to its client.
//
// A point, velocity or chunk for which there is no space, as in a burst after a network stall, is
// kept until there is; a newer one supersedes it.
#pragma once

#include "gateway/joint_turns.hpp"
#include "gateway/reference_server.hpp"
#include "gateway/server/report_book.hpp"
#include "gateway/verdict_text.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

/// A report for a client.
struct ClientReport {
  Origin to;
  Outcome outcome = Outcome::kRefused;
  Verdict verdict;
  double time_s = 0.0, stretch = 0.0;
  ControlEffect effect = {};  ///< of an executed control
};

/// Credit for a client.
struct Credit {
  Origin to;
  int waypoints = 0;
};

template <class SpaceOfReferences>
class ReferenceIntake {
 public:
  using Space = SpaceOfReferences;

  ReferenceIntake(ReferenceClient<Space>& client, const PortTable& ports)
      : client_(client), server_(client, ports) {}

  /// Sends a point; it is newer than all before.
  Verdict point(const Origin& from, const TrajectoryTerms& terms,
                const typename Space::Point& point, const PointDetails& details);
  /// Sends a chunk, whose header the terms give; it is newer than all before. kNoFreeStore: all
  /// chunks are in force or wait for their first target.
  Verdict chunk(const Origin& from, const TrajectoryTerms& terms, Chunk<Space>& chunk);
  /// Sends a velocity; it is newer than all before.
  Verdict velocity(const Origin& from, const TrajectoryTerms& terms, Velocity<Space>& velocity);
  /// Number of chunks sent.
  std::uint32_t chunks() const { return chunks_; }
  /// Counters and margins of chunks and velocities.
  const StreamState& stream() const { return client_.stream(); }
  /// Sends a control. Controls of clients other than the owner fill at most half of the mailbox.
  Verdict control(const Origin& from, ControlKind kind, double rate, const ControlEffect& effect);
  /// Begins a trajectory; what was begun before and has not ended is given up. One that is only
  /// judged waits for that of another client: kNoFreeStore.
  Verdict begin(const Origin& from, const TrajectoryTerms& terms);
  /// Says how the angles of the trajectory that was begun are taken. [any, not cyclic]
  void take_angles(Wrap wrap, const JointVector& reference, std::uint32_t held) {
    turns_.begin(wrap, reference);
    turns_.leave_out({held});
    warned_ = false;
  }
  /// Returns the text for a report on the trajectory that was begun last: the cause of a
  /// refusal, or, once, a warning that it takes a long way. Empty: there is none.
  Message about_turns(const ClientReport& report);
  /// Stages a waypoint of the trajectory that `from` has begun, for which it has credit.
  void take(const Waypoint<Space>& waypoint);
  /// No waypoints follow.
  Verdict end(const Origin& from);
  /// True if the trajectory in transfer is from this client.
  bool comes(const Origin& from) const { return coming_ && origin_.session == from.session; }
  /// Waypoints of the trajectory that `from` has begun for which it has credit; 0 if it has begun
  /// none, or ended it.
  int credit(const Origin& from) const { return comes(from) && !ended_ ? outstanding_ : 0; }
  /// True if the trajectory that `from` has begun is only judged.
  bool checks(const Origin& from) const { return comes(from) && checks_; }
  /// Fields of the trajectory in transfer.
  Fields fields() const { return fields_; }
  /// Ends the trajectory that `from` has begun, because something in it is refused.
  void refuse(const Origin& from, const Verdict& verdict) {
    if (comes(from)) fail(verdict, Outcome::kRefused);
  }

  /// Gives up the trajectory that a session transfers, if there is one; what of it moves is to be
  /// canceled.
  void give_up(std::uint64_t session);
  /// Brings to rest on its path whatever moves. Nothing else is taken before the generator has
  /// space for it.
  void cancel();
  /// True while a cancel of a client is not yet in force.
  bool canceling() const { return canceling_ != 0; }
  /// Voids the reference that waits for space.
  void drop_waiting();
  /// No more reports are sent about the references of a session.
  void forget(std::uint64_t session);

  /// Moves staged waypoints on, and takes the next report that concerns a client. False: there is
  /// none. To be called until there is none.
  bool work(ClientReport& result);
  /// New credit of the client that transfers a trajectory; false: there is none.
  bool grant(Credit& credit);

  bool poll_feedback(Feedback<Space>& feedback) { return client_.poll_feedback(feedback); }
  /// The client's number of the trajectory with this number in the channel; 0: none of it.
  std::uint32_t number_of(std::uint32_t id, std::uint64_t session);
  const AdmissionSettings<Space>& settings() const { return client_.settings(); }

 private:
  /// A reference as received; a chunk without its targets.
  struct Reference {
    RequestKind kind = RequestKind::kPoint;
    Origin from;
    TrajectoryTerms terms;
    typename Space::Point point;
    PointDetails details;
    Velocity<Space> velocity;
  };

  bool busy() const {
    return book_.full() || cancel_due_ || report_count_ + 3 > static_cast<int>(reports_.size());
  }
  Verdict post(const Reference& reference, Chunk<Space>& chunk, std::uint32_t& id);
  std::uint32_t present_epoch() const;
  Verdict offer(const Reference& reference, Chunk<Space>& chunk);
  bool finds_no_space(const Verdict& verdict) const;
  void queue_report(const Origin& to, Outcome outcome, const Verdict& verdict,
                    double stretch = 0.0);
  bool send_waiting();
  void move_on();
  void note_sent();
  void fail(const Verdict& verdict, Outcome outcome);
  bool translate(const Report& report, ClientReport& result);

  ReferenceClient<Space>& client_;
  ReferenceServer<Space> server_;
  ReportBook book_;
  ReportBook::Entry stream_;  // the chunk or velocity in force, which can only starve
  std::uint32_t sequence_ = 0, chunks_ = 0;

  bool cancel_due_ = false;  // one that found no space
  // The newest cancel of a client and of the server, until it is in force; 0: none.
  std::uint32_t canceling_ = 0, ending_ = 0;

  bool waits_ = false;  // a reference, for space
  Reference waiting_;
  Chunk<Space> waiting_chunk_;

  bool coming_ = false;  // a trajectory is in transfer
  bool ended_ = false;   // all its waypoints have arrived
  bool checks_ = false;  // it is only judged
  Origin origin_;        // of its Begin
  Fields fields_ = 0;
  int free_ = 0;          // waypoints that its window takes before it is sent
  int outstanding_ = 0;   // credit that is not used
  std::uint32_t id_ = 0;  // once the generator has it; 0: not yet
  std::array<Waypoint<Space>, kStagedWaypoints> staged_;
  int first_ = 0, count_ = 0;
  JointTurns turns_;
  bool warned_ = false;
  // On references that ended before the generator received them.
  std::array<ClientReport, 2 * kMessagesPerTurn> reports_;
  int report_count_ = 0;
};

/// The intake of the references that a pipeline takes, joints or poses, and the epoch that voids
/// those sent before a stop.
class References {
 public:
  References(const Pipeline& pipeline, ReferenceClient<JointSpace>& joints,
             ReferenceClient<TaskSpace>& poses)
      : pipeline_(pipeline), joints_(joints, pipeline.ports), poses_(poses, pipeline.ports) {}

  bool takes_poses() const { return pipeline_.takes_poses; }
  /// False: the pipeline follows its own reference.
  bool takes_any() const { return pipeline_.takes_poses || pipeline_.takes_joints; }
  /// True if a Begin may request the nearest turn of joints without stops.
  bool wraps() const {
    return Robot::kContinuousJoints != 0 && pipeline_.takes_joints && !takes_poses();
  }
  VerdictAxes axes() const { return takes_poses() ? VerdictAxes::kTip : VerdictAxes::kJoints; }
  /// Calls act(intake) with the intake of the pipeline's space.
  template <class Act>
  auto with_intake(Act act) {
    return takes_poses() ? act(poses_) : act(joints_);
  }

  std::uint32_t epoch() const { return epoch_; }
  /// Voids all references sent before, whether they name an epoch or not.
  void begin_epoch() {
    ++epoch_;
    if (takes_any()) with_intake([](auto& intake) { intake.drop_waiting(); });
  }
  /// Brings the arm to rest on its path, and voids all references sent before.
  void end_motion() {
    begin_epoch();
    if (takes_any()) with_intake([](auto& intake) { intake.cancel(); });
  }
  /// True while a cancel of a client is not yet in force.
  bool canceling() const { return takes_poses() ? poses_.canceling() : joints_.canceling(); }
  /// Gives up the trajectory that a session is sending.
  void give_up(std::uint64_t session) {
    joints_.give_up(session);
    poses_.give_up(session);
  }
  /// Sends no more reports about the references of a session.
  void forget(std::uint64_t session) {
    joints_.forget(session);
    poses_.forget(session);
  }

 private:
  const Pipeline& pipeline_;
  ReferenceIntake<JointSpace> joints_;
  ReferenceIntake<TaskSpace> poses_;
  std::uint32_t epoch_ = 1;
};

}  // namespace tactus
