// CycleDesk: the cycle's end of CycleMail. After each cycle it takes at most one order and posts at
// most one snapshot, whatever clients do; it never waits.
#pragma once

#include "gateway/server/cycle_mail.hpp"
#include "kernel/control/wrench_front_end.hpp"
#include "kernel/cycle/executive.hpp"

namespace tactus {

class CycleDesk {
 public:
  /// Finds the outputs that are told in the loaded pipeline: the first called q_d, dq_d and x_d of
  /// a reference, x of the robot model, h of a wrench. [init]
  CycleDesk(CycleMail& mail, Executive& executive, Pipeline& pipeline);

  /// Tells the values of all outputs too, in every `divisor`-th cycle. [init]
  void show(PortMail& ports) { port_mail_ = &ports; }
  /// Takes an order and a set of parameters, and goes on with arming; `status` is that of the last
  /// cycle. [between two cycles]
  void work(Status status);
  /// Tells the cycle that has begun at `now`. [between two cycles]
  void tell(const CycleTime& now);

 private:
  void watch_faults();
  void arm();
  void take_order();
  void take_parameters();
  TuningVerdict retune(const Tuning& tuning);
  void finish(Status status);
  void begin_tare(std::uint32_t id);
  void end_tare();
  void tell_ports();

  CycleMail& mail_;
  Executive& executive_;
  Pipeline& pipeline_;
  const JointVector *q_d_ = nullptr, *dq_d_ = nullptr;
  const Pose *pose_ = nullptr, *pose_d_ = nullptr;
  const Vector6* wrench_ = nullptr;
  WrenchFrontEnd* front_end_ = nullptr;  // null: the pipeline has none, or more than one
  std::uint32_t tare_ = 0;               // number of a tare that is under way; 0: none
  Vector6 zero_before_ = Vector6::Zero();
  std::uint32_t rearm_ = 0;        // number of a rearm that is under way; 0: none
  bool waits_ = false;             // it has not begun: the arm is still being brought to rest
  std::uint32_t events_ = 0;       // of the executive, that are read
  std::uint32_t faults_ = 0;       // that have braked or disabled the arm
  std::uint32_t lost_ = 0;         // snapshots
  PortMail* port_mail_ = nullptr;  // null: nobody watches the wires
  PortValues port_values_;         // that are being told
};

}  // namespace tactus
