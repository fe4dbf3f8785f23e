// CycleMail: the messages between the cycle's thread and the server's, both ways without waiting.
// References have their own channel (kernel/reference/generator/messages.hpp); here is the rest:
// orders to the executive, their results, and the state of every cycle for those who watch.
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
  std::uint32_t faults = 0;  ///< of the newest snapshot that its sender had
};
struct OrderResult {
  std::uint32_t id = 0;
  Verdict verdict = {};
  Vector6 zero = Vector6::Zero(), zero_before = Vector6::Zero();  ///< of the sensor, of a tare
};

/// A set of parameters; there is one at a time.
struct TuningMessage {
  const Tuning* tuning = nullptr;
};

/// What is told of one cycle, after it.
struct CycleSnapshot {
  /// Bits of `has`: what the pipeline has of the values below.
  enum : std::uint8_t { kJointReference = 1, kPose = 2, kPoseReference = 4, kWrench = 8 };

  std::int64_t stamp_ns = 0;  ///< its begin
  double time_s = 0.0;        ///< of the generator
  std::uint32_t cycle = 0, slips = 0, overruns = 0;
  std::uint32_t lost = 0;    ///< snapshots for which there was no space, up to now
  std::uint32_t faults = 0;  ///< that have braked or disabled the arm, up to now
  std::uint8_t rung = 0, phase = 0, has = 0;
  Status status = Status::kOk;
  FaultVerdict fault;  ///< that status, with joint or axis, value and limit if they are known
  const char *first = nullptr, *second = nullptr;  ///< names of what collides; null: nothing
  double override = 1.0, speed_scaling = 1.0;
  JointVector q = JointVector::Zero(), dq = JointVector::Zero(), tau = JointVector::Zero();
  JointVector q_d = JointVector::Zero(), dq_d = JointVector::Zero();
  Pose pose, pose_d;
  Vector6 wrench = Vector6::Zero();
  DigitalOutputs outputs;  ///< as commanded
};

/// The numbers of every output of the pipeline after one cycle: of the first in the port table,
/// then of the next. Those that the recorder does not take have none.
struct PortValues {
  static constexpr std::size_t kMost = kMaxPorts * std::size_t{7};
  std::uint32_t cycle = 0;
  std::array<double, kMost> numbers{};
};

/// For those who watch the wires: values now and then. A box that is not emptied gets no more.
struct PortMail {
  int divisor = 100;  ///< cycles from one to the next
  Mailbox<PortValues, 2> values;
};

struct CycleMail {
  Mailbox<OrderMessage, 8> orders;  ///< at most one is taken in a cycle
  Mailbox<OrderResult, 16> results;
  Mailbox<TuningMessage, 2> tunings;  ///< whose bytes are the cycle's until its verdict
  Mailbox<TuningVerdict, 2> tuned;
  Mailbox<CycleSnapshot, 32> snapshots;  ///< one of every cycle that finds space
};

}  // namespace tactus
