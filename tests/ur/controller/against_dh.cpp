// A program: against_dh FILE compares the kernel's model of the calibrated arm that it is compiled
// for with the parameters in FILE, which scripts/robot-calibrate has saved, at 1000 random states:
// the flange with their product, capsules and torques with those of the nominal arm. It prints the
// largest differences; its exit code is 0 if the arm of FILE fits the table, and no other.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>

#include "hal/ur/arm_calibration.hpp"
#include "kernel/model/inverse_dynamics.hpp"
#include "kernel/model/link_frames.hpp"
#include "kernel/robots/robot.hpp"

namespace tactus {
namespace {

using Frame = Eigen::Isometry3d;

ur::ArmCalibration read(const char* path) {
  ur::ArmCalibration arm;
  arm.told = true;
  std::ifstream file(path);
  std::string key, equals;
  for (std::size_t row = 0; row < 4; ++row) {
    file >> key >> equals;
    for (std::size_t i = 0; i < 6; ++i) file >> arm.parameters[6 * row + i];
  }
  file >> key >> equals;
  for (std::uint32_t& sum : arm.checksums) file >> std::hex >> sum;
  return arm;
}

/// prod RotZ(theta + q) TransZ(d) TransX(a) RotX(alpha)
Frame flange(const std::array<double, 24>& dh, const Vector6& q) {
  Frame at = Frame::Identity();
  for (std::size_t i = 0; i < 6; ++i)
    at = at * Eigen::AngleAxisd(dh[i] + q[static_cast<int>(i)], Vector3::UnitZ()) *
         Eigen::Translation3d(dh[6 + i], 0.0, dh[12 + i]) *
         Eigen::AngleAxisd(dh[18 + i], Vector3::UnitX());
  return at;
}

struct Worst {
  double pose = 0.0, capsule = 0.0, torque = 0.0;

  void see(const std::array<double, 24>& dh, const Vector6& q, const Vector6& dq,
           const Vector6& ddq) {
    JacobianOf<Robot> jacobian;
    const Pose x = forward_kinematics<Robot>(joint_trig<Robot>(q), Pose{}, jacobian);
    const Frame told = flange(dh, q);
    pose = std::max({pose, (x.p - told.translation()).cwiseAbs().maxCoeff(),
                     (x.r.toRotationMatrix() - told.linear()).cwiseAbs().maxCoeff()});
    const auto frames = link_frames<Robot>(joint_trig<Robot>(q));
    const auto nominal = link_frames<Ur10>(joint_trig<Ur10>(q));
    for (std::size_t k = 0; k < RobotCapsules::kCapsules.size(); ++k) {
      const LinkCapsule &ours = RobotCapsules::kCapsules[k], &its = Capsules<Ur10>::kCapsules[k];
      const auto link = static_cast<std::size_t>(ours.link);
      for (const auto& [a, b] : {std::pair{ours.a, its.a}, std::pair{ours.b, its.b}})
        capsule =
            std::max(capsule, (frames[link].at(Vector3(a)) - nominal[link].at(Vector3(b))).norm());
    }
    const Tool none;
    const Vector6 tau = inverse_dynamics<Robot>(joint_trig<Robot>(q), dq, ddq, none);
    const Vector6 of_nominal = inverse_dynamics<Ur10>(joint_trig<Ur10>(q), dq, ddq, none);
    torque = std::max(torque, (tau - of_nominal).cwiseAbs().maxCoeff());
  }
};

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  ur::ArmCalibration arm = read(argv[1]);
  std::mt19937_64 random(4);
  const auto drawn = [&random](double most) {
    Vector6 v;
    for (double& value : v) value = most * (2.0 * 0x1p-64 * static_cast<double>(random()) - 1.0);
    return v;
  };
  Worst worst;
  for (int i = 0; i < 1000; ++i) {
    const Vector6 q = drawn(3.14), dq = drawn(2.0), ddq = drawn(5.0);
    worst.see(arm.parameters, q, dq, ddq);
  }
  std::printf("pose %.3g capsule %.3g m torque %.3g N m\n", worst.pose, worst.capsule,
              worst.torque);
  const bool fits = arm.fits_table();
  arm.checksums[5] ^= 1u;
  return fits && !arm.fits_table() ? 0 : 1;
}
