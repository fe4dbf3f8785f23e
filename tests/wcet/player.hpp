// Player: plays a tape through the executive, without a plant. The same source runs on the host,
// under the search and on the bare Cortex-M7. Requests pass through the client's own admission, so
// a cycle sees whatever a client can send, however hostile, and nothing else.
#pragma once

#include <string_view>

#include "gateway/reference_client.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "program/sim/sim_sections.hpp"
#include "tests/wcet/tape.hpp"

namespace tactus {

/// The outside of a player: a robot that measures what the tape says and ignores every command, and
/// a client that ignores what it is told. A test that looks at either overrides it.
class TapeHal : public Hal {
 public:
  RobotState state;

  Capabilities capabilities() const override { return {true, true, true, 100, 100000, true}; }
  TapeHal() { state.drives.fill({DriveState::kEnabled, true}); }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& measured) override {
    measured = state;
    measured.stamp_ns = now.stamp_ns;
    return Status::kOk;
  }
  Status write(const RobotCommand&) override { return Status::kOk; }
  Status disconnect() override { return Status::kOk; }

  virtual void told(const Verdict&) {}
  virtual void told(const Report&) {}
  virtual void told(const Feedback<JointSpace>&) {}
  virtual void told(const Feedback<TaskSpace>&) {}

 protected:
  ~TapeHal() = default;
};

/// A client's path into a generator of one space.
template <class Space>
struct TapeClient {
  static constexpr int kCapacity = 64;  // waypoints of a store

  TapeClient();
  void poll(TapeHal& outside);

  ChannelMemory<Space> channel;
  ReferenceClient<Space> client{channel};
  Waypoint<Space> waypoints[kStores][kCapacity];
  Trajectory<Space>* sent = nullptr;  ///< the last trajectory
};

class Player {
 public:
  explicit Player(const Timing& timing = {}) : Player(ignorant_, timing) {}
  explicit Player(TapeHal& outside, const Timing& timing = {})
      : hal_(outside), executive_(hal_, pipeline_, timing) {}
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// Loads a pipeline as a simulated board does, without the board's own sections; once.
  Status load(std::string_view text, LoadError& error);
  /// Gives the first store of joint trajectories this place for its waypoints; before load().
  void widen(Waypoint<JointSpace>* waypoints, int capacity);
  /// Begins a tape; once for every Player.
  void insert(const Bytes& tape) { tape_ = tape; }

  /// Executes the tape's operations up to its next cycle; false at its end.
  bool prepare();
  /// Runs that cycle, and nothing else.
  Status cycle() { return executive_.cycle({stamp_ns_}); }

  const Executive& executive() const { return executive_; }
  /// Number of cycles in which the arm was taken over; they are none of the tape's.
  std::uint32_t arming_cycles() const { return arming_cycles_; }
  const Pipeline& pipeline() const { return pipeline_; }
  int accepted() const { return accepted_; }  ///< requests that passed admission

 private:
  void apply(TapeOp op);
  void start();
  void take_fractions(JointVector& value, const JointVector& low, const JointVector& high);
  TaskSpace::Point near_reference(const TaskSpace::Header& header, Fields fields);
  TaskSpace::Header take_terms(std::uint8_t frames) const;
  void take_point();
  void take_trajectory();
  void take_waypoints();
  template <class Space>
  void send_waypoints(TapeClient<Space>& to);
  void take_append();
  void note(const Verdict& verdict);

  struct Ignorant final : TapeHal {};

  Bytes tape_;
  Ignorant ignorant_;
  TapeHal& hal_;
  TapeClient<JointSpace> joints_;
  TapeClient<TaskSpace> poses_;
  RoomyPipeline pipeline_;
  SimSections board_;
  Executive executive_;
  const Pose* reference_ = nullptr;  ///< x_d of the task-space generator, if there is one
  std::uint32_t arming_cycles_ = 0;
  bool started_ = false;
  int repeats_ = 0, deaf_ = 0, accepted_ = 0;
  std::int64_t stamp_ns_ = 0, late_ns_ = 0;
};

}  // namespace tactus
