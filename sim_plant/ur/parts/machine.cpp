#include "sim_plant/ur/parts/machine.hpp"

#include <Eigen/Cholesky>

namespace tactus::ur {

/// Returns the motor torque beyond the model, mapped by the transposed Jacobian; damped, so that it
/// is finite in singular postures.
Vector6 Machine::estimated_wrench() const {
  const Eigen::Matrix<double, 6, 6> j = jacobian(measured_q(), motion.tool());
  Eigen::Matrix<double, 6, 6> jj = j * j.transpose();
  jj.diagonal().array() += 1e-3;
  return jj.ldlt().solve(j * (sensors.torque_error() - body.residual()));
}

}  // namespace tactus::ur
