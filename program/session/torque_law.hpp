// TorqueLaw: where the law that gives a pipeline's torque is to hold the arm, its gains, and its
// own limit.
#pragma once

#include <type_traits>

#include "kernel/pipeline/kinds.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

struct TorqueLaw {
  const Name* block = nullptr;
  const JointVector* q_d = nullptr;    ///< rad; null: no position law gives the torque
  const JointVector* dq_d = nullptr;   ///< rad/s; null: it takes none
  const JointVector* limit = nullptr;  ///< N m, at which it saturates; null: it does not
  JointVector kp = JointVector::Zero(), kd = JointVector::Zero();  ///< N m/rad, N m s/rad
  bool damps_error = false;         ///< kd acts on dq_d - dq, not on the arm's own velocity
  const char* nonlinear = nullptr;  ///< what makes it another law than kp and kd; null: nothing
};

template <class Kind, class = void>
struct TakesVelocity : std::false_type {};
template <class Kind>
struct TakesVelocity<Kind, std::void_t<decltype(std::declval<Kind>().dq_d.source)>>
    : std::true_type {};

template <class Kind, class = void>
struct Saturates : std::false_type {};
template <class Kind>
struct Saturates<Kind, std::void_t<decltype(std::declval<Kind>().params.output_limit)>>
    : std::true_type {};

inline void add_gains(const PdGravity& law, TorqueLaw& found) {
  found.kp = law.params.kp;
  found.kd = law.params.kd;
}

inline void add_gains(const Pid& law, TorqueLaw& found) {
  const Pid::Params& params = law.params;
  found.kp = params.gains.kp;
  found.kd = params.gains.kd;
  found.damps_error = params.derivative == Derivative::kError;
  if (!found.damps_error && !params.gains.ki.isZero(0.0))
    found.nonlinear = "its integral makes up for kd on the measurement";
  if (!(found.kp.array() > 0.0).all()) found.nonlinear = "kp is 0";
  if (!(found.kd.array() > 0.0).all()) found.nonlinear = "kd is 0";
  if (!params.derivative_time_constant.isZero(0.0)) found.nonlinear = "it filters the derivative";
  if (!params.dead_band.isZero(0.0)) found.nonlinear = "it has a dead band";
  if (!params.velocity_gain.isZero(0.0)) found.nonlinear = "it has a velocity_gain";
  if (!params.acceleration_gain.isZero(0.0)) found.nonlinear = "it has an acceleration_gain";
}

/// Returns what the block that gives the torque takes, of a pipeline that is loaded. [init]
inline TorqueLaw torque_law(const Pipeline& pipeline) {
  TorqueLaw found;
  for (int i = 0; i < pipeline.count(); ++i) {
    const Block& block = pipeline[i];
    with_kind(block.kind, [&](auto type) {
      using Kind = typename decltype(type)::Type;
      if constexpr (kIsTorqueLaw<Kind>) {
        const Kind& law = *static_cast<const Kind*>(block.place);
        if (&law.tau.value != pipeline.robot.tau_c.source) return;
        found.block = &block.name;
        found.q_d = law.q_d.source;
        add_gains(law, found);
        if constexpr (TakesVelocity<Kind>::value)
          if (law.dq_d.wired()) found.dq_d = law.dq_d.source;
        if constexpr (Saturates<Kind>::value) found.limit = &law.params.output_limit;
      }
    });
  }
  return found;
}

}  // namespace tactus
