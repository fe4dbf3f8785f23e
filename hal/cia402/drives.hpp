// Drives: the CiA 402 drives of all joints as one robot, over any bus: armed together or not at
// all.
//
// A bus hands the newest process data to watch() and takes the commands of step(), in every cycle.
// Arming: every drive is taken to "switched on", its old fault cleared; one that has lost its
// reference is homed by the method of the file, one after the other; then all of them are enabled
// in the same cycle, and hold the arm while their brakes open. An arm that moves then is
// not armed again before the next attach(): it would move on. As soon as one drive leaves
// "operation enabled", is silent for too long or reports an error, all drives get a quick stop in
// that cycle, and no command before the next arming.
#pragma once

#include "hal/cia402/cia402_settings.hpp"
#include "hal/cia402/drive_machine.hpp"
#include "hal/cia402/drive_wire.hpp"
#include "hal/cia402/feedback_watch.hpp"
#include "hal/cia402/hold_effort.hpp"
#include "hal/cia402/homing.hpp"
#include "hal/cia402/joint_units.hpp"
#include "kernel/core/hal.hpp"

namespace tactus::cia402 {

/// "joint 3": how messages name a drive. [any]
inline Message joint_text(int joint) {
  Message text("joint ");
  text << joint + 1;
  return text;
}

enum class ArmingPhase : std::uint8_t {
  kOff,
  kSwitchingOn,  ///< faults are cleared; no torque
  kHoming,       ///< of one drive, alone; the brakes of the others are closed
  kEnabling,     ///< all at once
  kReleasing,    ///< the motors hold the arm; the brakes open
  kArmed,        ///< holds, or follows commands
  kStopping,
  kFailed,  ///< stopping by a fault; stays until the drives are requested to be disabled
};

class Drives {
 public:
  /// Cycles in a row in which the positions must agree before the drives are enabled.
  static constexpr int kSteady = 5;
  static constexpr int kConfirming = 3;
  /// Cycles after which one missing feedback is no longer counted; what arrives from then on may be
  /// older by one cycle.
  static constexpr int kForgotten = 1000;

  /// Takes the settings, which must outlive the use of the drives, the period and the longest time
  /// of arming. kMissingKey, kBadValue, with `why`: a rated torque, direction, encoder, bit or
  /// method that cannot be, a torque limit that is beyond the drive's numbers, an arming that could
  /// end in the midst of homing. [init]
  Status configure(const Cia402Settings& settings, const Tool& tool, int period_us, int arming_ms,
                   Message& why);
  /// Takes the units of velocity per motor revolution per second; NaN where they are not known and
  /// no velocity travels. Before attach(). [init]
  void set_velocity_units(const JointVector& units);
  /// Takes over the drives as they are, disabled or not, for commands of `mode`. kNotReferenced
  /// for a position outside the joint's range, unless arming homes the drive. [init]
  Status attach(CommandMode mode, const Feedbacks& feedbacks, Message& why);

  /// The joints that arming would home now, with their methods: "joint 2 (method 35)"; empty: none.
  /// [init]
  Message to_home() const;

  /// Takes the newest process data, sampled at `sampled_ns`, and finds faults. [cyclic]
  void watch(const Feedbacks& feedbacks, std::int64_t sampled_ns);
  /// Takes every drive a step towards what is requested. [cyclic]
  void step(const RobotCommand& command, DriveCommands& out, std::int64_t now_ns);
  /// The request that the bus is to send to a drive. It may change before the answer: then the new
  /// one counts.
  /// [cyclic]
  const ObjectRequest& request() const { return request_; }
  /// Takes the answer to request(): what was read, or why it was not done. [cyclic]
  void answer(std::uint32_t value, const ObjectRefusal& refused = {});
  /// True if no drive has power any more, as far as is known. [cyclic]
  bool off() const { return phase_ == ArmingPhase::kOff; }
  /// True if the drive of a joint, from 0, has shown in kConfirming samples in a row that it is
  /// disabled, as requested: a single statusword may predate the request. [cyclic]
  bool confirmed(int joint) const {
    return joints_[static_cast<std::size_t>(joint)].confirmed == kConfirming;
  }
  /// A value and its limit, for the words of a fault.
  struct Figures {
    double value = 0.0, limit = 0.0;
  };
  /// Fails the joint, from 0, as a fault of its drive does. The texts are constants; why() puts
  /// them together: with figures, the value between the first two, the limit before the last.
  /// [cyclic]
  void fail(int joint, Status reason, std::uint32_t code, const char* what, const char* detail = "",
            const char* rest = "", const Figures* figures = nullptr);

  /// Fills in positions, velocities, torques, their stamp and the drives. [cyclic]
  void show(RobotState& state) const;
  ArmingPhase phase() const { return phase_; }
  /// The last fault in words, with its joint. [between two cycles]
  Message why() const;

 private:
  struct Joint {
    JointUnits units;
    PositionCounter counter;
    DriveMachine machine;
    DriveFeedback last;
    FeedbackWatch watch;
    double q = 0.0, dq = 0.0, tau = 0.0;
    std::int64_t stamp_ns = 0;
    int missed = 0;                // cycles in a row
    int limited = 0;               // the same, in which it limits its command by its own word
    int owed = 0, since_owed = 0;  // cycles without feedback that are not forgotten, cycles since
    int confirmed = 0;             // samples in a row that show it disabled
    bool homes = false;            // its mode is homing, or was not seen to be another
    bool placed = true;            // q is of a drive with a position reference
    Status reason = Status::kOk;   // of its failure
    std::uint32_t code = 0;

    /// The drive's own count at q, rad.
    std::int32_t count_of(double at) const {
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(units.position(at)) -
                                       static_cast<std::uint32_t>(counter.added()));
    }
  };

  /// Parts of the text of why(). A cycle writes no text: that takes longer than all its other work.
  struct Failure {
    int joint = -1;  // -1: nothing has failed
    std::uint32_t code = 0;
    std::uint16_t seen = 0;  // the last statusword, of a drive that was to be enabled
    const char *what = "", *detail = "", *rest = "";
    bool has_figures = false;
    Figures figures;
  };

  bool place(int j, std::int32_t count);
  Status attach_joint(int j, const DriveFeedback& feedback, Message& why);
  void measure(int j, const DriveFeedback& feedback, std::int64_t sampled_ns);
  void count_missed(Joint& joint, const DriveFeedback& feedback);
  void judge(int j);
  void judge_hold(int j);
  void judge_belief(int j);
  bool enabled() const {
    return phase_ == ArmingPhase::kReleasing || phase_ == ArmingPhase::kArmed;
  }
  bool rising() const {
    return phase_ >= ArmingPhase::kSwitchingOn && phase_ <= ArmingPhase::kEnabling;
  }
  bool homes(int j) const { return phase_ == ArmingPhase::kHoming && j == homing_.joint; }
  bool operates(int j) const { return enabled() || (homes(j) && homing_.operates()); }
  Drive drive_of(const Joint& joint) const;
  bool follows(const RobotCommand& command);
  void set_target(const RobotCommand& command, bool follow, DriveCommands& out);
  JointVector effort(const RobotCommand& command, bool follow, const JointVector& q,
                     const JointVector& dq);

  // drives_arming.cpp: the steps of arming, with homing, and of stopping.
  void take(DriveRequest request);
  void set_controlwords(DriveCommands& out, std::int64_t now_ns);
  void count_confirmations();
  void advance(std::int64_t now_ns);
  bool ready(int j);
  Goal goal() const;
  Goal goal_of(int j) const;
  bool all_reached() const;
  void judge_rise();
  void judge_time();
  void judge_steadiness();
  void enter(ArmingPhase phase, std::int64_t now_ns);
  void ask(int joint, const Object& object);
  void write_object(int joint, const Object& object, std::int8_t value);
  void judge_mode(std::uint32_t value, const ObjectRefusal& refused);
  bool referenced(int j) const;
  bool needs_homing(int j) const;
  void go_up(std::int64_t now_ns);
  void begin_homing(int j, std::int64_t now_ns);
  void enter(Homing::Step step, std::int64_t now_ns);
  void home(std::int64_t now_ns);
  void judge_display(Mode wanted, Homing::Step next, std::int64_t now_ns);
  void judge_motion(std::int64_t now_ns);
  bool judge_place(int j);
  std::int64_t half_period_ns() const { return static_cast<std::int64_t>(0.5e9 * period_s_); }

  const Cia402Settings* settings_ = nullptr;
  double period_s_ = 1.0;
  CommandMode mode_ = CommandMode::kEffort;
  ArmingPhase phase_ = ArmingPhase::kOff;
  std::int64_t since_ns_ = 0;  // in this phase; in kSwitchingOn, with all drives switched on
  std::array<Joint, kDof> joints_;
  HoldEffort hold_;
  JointLimits limits_;
  int steady_ = 0;          // cycles in a row in which no joint moved faster than it can
  int unsteady_ = 0;        // the last joint that did
  double jump_ = 0.0;       // how far from a cycle to the next, rad
  bool following_ = false;  // commands, in the last cycle
  int rise_left_ = 0;       // cycles until the executive ends this arming
  Homing homing_;
  ObjectRequest request_;
  int asked_ = 0;    // the number of the last request
  int checked_ = 0;  // joints whose display of the mode was checked in this arming
  JointVector held_ = JointVector::Zero();  // rad: of the hold of positions
  int most_rise_ = 0;                       // cycles of an arming, by [executive] arming_ms
  int moved_ = -1;                          // the joint that left its hold since attach(); -1: none
  double moved_from_ = 0.0;                 // rad: where it was held
  Failure failure_;
};

}  // namespace tactus::cia402
