// CycleMailboxes: the lock-free mailboxes between the thread of the cycle and that of the server.
// They carry orders to the executive, their results, parameter sets, and a snapshot of every cycle;
// references have their own channel (kernel/reference/generator/messages.hpp).
#pragma once

#include <array>

#include "gateway/verdict_text.hpp"
#include "kernel/core/digital_outputs.hpp"
#include "kernel/core/mailbox.hpp"
#include "kernel/core/types.hpp"
#include "kernel/core/verdict.hpp"
#include "kernel/pipeline/port_table.hpp"
#include "kernel/pipeline/tuning.hpp"

namespace tactus {

enum class CycleOrder : std::uint8_t {
  kStop,   ///< brake the whole chain on its path, then disable the drives
  kRearm,  ///< take the arm over again
  kTare,   ///< take a new zero of the force/torque sensor
};

struct OrderMessage {
  std::uint32_t id = 0;
  CycleOrder order = CycleOrder::kStop;
  std::uint32_t faults = 0;  ///< fault count of the newest snapshot that the sender had
};
struct OrderResult {
  std::uint32_t id = 0;
  Verdict verdict = {};
  Vector6 zero = Vector6::Zero(), zero_before = Vector6::Zero();  ///< sensor zero, for a tare
};

/// A set of parameters; there is one at a time.
struct TuningMessage {
  const Tuning* tuning = nullptr;
};

/// State of the arm and of the executive after one cycle.
struct CycleSnapshot {
  /// Bits of `has`: which of the values below the pipeline provides.
  enum : std::uint8_t { kJointReference = 1, kPose = 2, kPoseReference = 4, kWrench = 8 };

  std::int64_t stamp_ns = 0;  ///< beginning of the cycle
  double time_s = 0.0;        ///< time of the generator
  std::uint32_t cycle = 0, slips = 0, overruns = 0;
  std::uint32_t lost = 0;    ///< snapshots dropped for lack of space, so far
  std::uint32_t faults = 0;  ///< faults that braked or disabled the arm, so far
  std::uint8_t rung = 0, phase = 0, has = 0;
  Status status = Status::kOk;
  FaultVerdict fault;  ///< `status`, with joint or axis, value and limit where known
  const char *first = nullptr, *second = nullptr;  ///< names of the colliding bodies; null: none
  double override = 1.0, speed_scaling = 1.0;
  JointVector q = JointVector::Zero(), dq = JointVector::Zero(), tau = JointVector::Zero();
  JointVector q_d = JointVector::Zero(), dq_d = JointVector::Zero();
  Pose pose, pose_d;
  Vector6 wrench = Vector6::Zero();
  DigitalOutputs outputs;  ///< as commanded
};

/// The values of all pipeline outputs after one cycle, in the order of the port table. Outputs that
/// the recorder does not take are skipped.
struct PortValues {
  static constexpr std::size_t kMost = kMaxPorts * std::size_t{7};
  std::uint32_t cycle = 0;
  std::array<double, kMost> numbers{};
};

/// Samples of the pipeline outputs for observers. Samples are dropped while the mailbox is full.
struct PortMailbox {
  int divisor = 100;  ///< cycles between two samples
  Mailbox<PortValues, 2> values;
};

struct CycleMailboxes {
  Mailbox<OrderMessage, 8> orders;  ///< at most one is taken in a cycle
  Mailbox<OrderResult, 16> results;
  Mailbox<TuningMessage, 2> tunings;  ///< the cycle owns a parameter set until its verdict
  Mailbox<TuningVerdict, 2> tuned;
  Mailbox<CycleSnapshot, 32> snapshots;  ///< one for each cycle, unless full
};

}  // namespace tactus
