#include "sim_plant/ur/parts/machine.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace tactus::ur {

/// Returns the motor torque beyond the model, mapped by the transposed Jacobian; damped, so that it
/// is finite in singular postures.
Vector6 Machine::estimated_wrench() const {
  const Eigen::Matrix<double, 6, 6> j = jacobian(measured_q(), motion.tool());
  Eigen::Matrix<double, 6, 6> jj = j * j.transpose();
  jj.diagonal().array() += 1e-3;
  return jj.ldlt().solve(j * (sensors.torque_error() - body.residual()));
}

void Watchdogs::set(const InputField& field, double min_frequency, LateAction action,
                    std::int64_t cycle) {
  const std::size_t variable = field.variable();
  std::size_t i = 0;
  while (i < count_ && watches_[i].variable != variable) ++i;
  if (i == watches_.size()) return;
  const bool asked = min_frequency > 0.0;
  const double longest_s = asked ? 1.0 / min_frequency : 0.0;
  watches_[i] = {variable, longest_s, asked ? action : LateAction::kIgnore, cycle, false};
  count_ = std::max(count_, i + 1);
}

LateAction Watchdogs::check(const Io& io, std::int64_t cycle, double cycle_s) {
  LateAction gravest = LateAction::kIgnore;
  for (std::size_t i = 0; i < count_; ++i) {
    Watch& watch = watches_[i];
    const std::int64_t last = std::max(io.written[watch.variable], watch.from);
    const bool late = static_cast<double>(cycle - last) * cycle_s > watch.longest_s + 1e-9;
    if (late && !watch.told) gravest = std::max(gravest, watch.action);
    watch.told = late;
  }
  return gravest;
}

}  // namespace tactus::ur
