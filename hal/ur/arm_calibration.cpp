#include "hal/ur/arm_calibration.hpp"

#include <cmath>

#include "kernel/robots/robot.hpp"

namespace tactus::ur {
namespace {

constexpr double kSame = 1e-9;  // m, rad: the digits of the manufacturer's own nominal table

/// True if the table is that of no arm in particular.
constexpr bool is_nominal() {
  for (const std::uint32_t sum : Robot::kCalibration)
    if (sum != 0) return false;
  return true;
}

/// The parameters of the table, in the order and the form of the controller's:
/// RotZ(theta) TransZ(d) TransX(a) RotX(alpha).
std::array<double, 24> of_table() {
  std::array<double, 24> parameters{};
  double alpha = 0.0;  // from the axis before
  for (std::size_t i = 0; i < 6; ++i) {
    const JointFrame& at = Robot::kJoints[i];
    const JointFrame& next = i < 5 ? Robot::kJoints[i + 1] : Robot::kFlange;
    parameters[i] = at.turn;
    parameters[6 + i] = next.x;
    parameters[12 + i] = at.z * std::cos(alpha) - at.y * std::sin(alpha);
    alpha = next.roll();
    parameters[18 + i] = alpha;
  }
  parameters[17] += Robot::kFlange.z;
  return parameters;
}

}  // namespace

bool ArmCalibration::take(ByteReader body) {
  ArmCalibration taken;
  taken.told = true;
  for (std::uint32_t& sum : taken.checksums) sum = body.u32();
  for (double& parameter : taken.parameters) parameter = body.f64();
  taken.in_force = body.u32() == kLinearised;
  if (!body.done()) return false;
  *this = taken;
  return true;
}

bool ArmCalibration::fits_table() const {
  if (!told) return false;
  if (!is_nominal()) return checksums == Robot::kCalibration;
  const std::array<double, 24> table = of_table();
  for (std::size_t i = 0; i < table.size(); ++i)
    if (!(std::abs(parameters[i] - table[i]) <= kSame)) return false;
  return true;
}

Status check_calibration(const ArmCalibration& calibration, const Message& off, Message& why) {
  if (calibration.fits_table()) return Status::kOk;
  if (!calibration.told) {
    why = Message("primary port: the controller has not told the arm's calibration; check");
    why << " primary_port and connect_ms, or do without by [ur] calibration = any";
    return Status::kBusTimeout;
  }
  why = Message("the arm has a calibration of its own, and this program the table of ");
  why << (is_nominal() ? "the nominal UR10" : "another arm");
  if (!off.empty()) why << ": the tip is " << off << " from where the table has it";
  if (calibration.in_force)
    why << "; scripts/robot-calibrate --address ADDRESS --name ur10_NAME writes the table and the"
           " board of this arm; or [ur] calibration = any takes it as it is";
  else
    why << ", but none in force; [ur] calibration = any takes it as it is";
  return Status::kMismatch;
}

}  // namespace tactus::ur
