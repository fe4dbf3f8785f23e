// CycleEndpoint: the cycle's end of CycleMailboxes. After each cycle it takes at most one order and
// posts at most one snapshot, whatever clients do; it never waits.
#pragma once

#include "gateway/server/cycle_mailboxes.hpp"
#include "kernel/control/wrench_front_end.hpp"
#include "kernel/cycle/executive.hpp"

namespace tactus {

class CycleEndpoint {
 public:
  /// Finds the outputs for the snapshots in the loaded pipeline: the first q_d, dq_d and x_d of a
  /// reference, x of the robot model, the first wrench h. [init]
  CycleEndpoint(CycleMailboxes& mailboxes, Executive& executive, Pipeline& pipeline);

  /// Also publishes the values of all outputs, in every `divisor`-th cycle. [init]
  void attach(PortMailbox& ports) { port_mailbox_ = &ports; }
  /// Takes an order and a set of parameters, and continues with arming; `status` is that of the
  /// last cycle. [between two cycles]
  void work(Status status);
  /// Posts the snapshot of the cycle that began at `now`. [between two cycles]
  void publish(const CycleTime& now);

 private:
  void watch_faults();
  void arm();
  void take_order();
  void take_parameters();
  TuningVerdict retune(const Tuning& tuning);
  void finish(Status status);
  void begin_tare(std::uint32_t id);
  void end_tare();
  void publish_ports();

  CycleMailboxes& mailboxes_;
  Executive& executive_;
  Pipeline& pipeline_;
  const JointVector *q_d_ = nullptr, *dq_d_ = nullptr;
  const Pose *pose_ = nullptr, *pose_d_ = nullptr;
  const Vector6* wrench_ = nullptr;
  WrenchFrontEnd* front_end_ = nullptr;  // null: the pipeline has none, or more than one
  std::uint32_t tare_ = 0;               // number of the tare in progress; 0: none
  Vector6 zero_before_ = Vector6::Zero();
  std::uint32_t rearm_ = 0;              // number of the rearm in progress; 0: none
  bool waits_ = false;                   // the rearm waits until the arm is at rest
  std::uint32_t events_ = 0;             // events of the executive that were read
  std::uint32_t faults_ = 0;             // that braked or disabled the arm
  std::uint32_t lost_ = 0;               // snapshots dropped
  PortMailbox* port_mailbox_ = nullptr;  // null: no observer
  PortValues port_values_;               // the sample being built
};

}  // namespace tactus
