#include "hal/ur/reported_tool.hpp"

#include <cmath>

#include "kernel/math/so3.hpp"
#include "kernel/model/forward_kinematics.hpp"
#include "kernel/robots/robot.hpp"

namespace tactus::ur {
namespace {

/// The tip frame in the flange frame, and whether the controller or the file gives it.
struct Tcp {
  Pose frame;
  bool known;
};

/// Returns a number as people read it, to 10 um.
double rounded(double value) {
  return std::round(value * 1e5) / 1e5 + 0.0;
}

Message numbers(const Vector3& v, const char* between) {
  Message text;
  text << rounded(v[0]) << between << rounded(v[1]) << between << rounded(v[2]);
  return text;
}

/// "(x, y, z) m"
Message place(const Vector3& p) {
  Message text("(");
  text << numbers(p, ", ") << ") m";
  return text;
}

Pose pose_of(const Vector6& v) {
  return {v.head<3>(), exp_so3(v.tail<3>())};
}

Tcp reported(const UrState& state) {
  if (state.tcp_offset.hasNaN()) return {Pose{}, false};
  return {pose_of(state.tcp_offset), true};
}

/// Appends what differs from a bare flange, and the keys of [robot] that state it.
void compare_payload(const UrState& state, Message& differs, Message& keys) {
  if (std::isnan(state.payload_kg) || std::abs(state.payload_kg) <= kZeroPayload_kg) return;
  const bool knows_com = !state.payload_com.hasNaN();
  const double mass_kg = rounded(state.payload_kg);
  differs << "the controller's payload is " << mass_kg << " kg";
  if (knows_com) differs << " at " << place(state.payload_com);
  differs << ", the model's tool weighs 0 kg";
  keys << "tool_mass = " << mass_kg;
  if (knows_com) keys << ", tool_com = " << numbers(state.payload_com, " ");
}

/// A mass without a place would move the controller's centre of mass to the flange.
void compare_com(const UrState& state, Message& differs, Message& keys) {
  if (state.payload_com.hasNaN() || state.payload_com.norm() <= kZeroTcp_m) return;
  differs << "the controller's payload has its centre at " << place(state.payload_com)
          << ", the model's tool at the flange";
  keys << "tool_com = " << numbers(state.payload_com, " ");
}

void compare_tcp(const UrState& state, Message& differs, Message& keys) {
  if (state.tcp_offset.hasNaN()) return;
  const Vector3 p = state.tcp_offset.head<3>();
  const double angle = log_so3(exp_so3(state.tcp_offset.tail<3>())).norm();
  if (p.norm() <= kZeroTcp_m && angle <= kTipAngle_rad) return;
  differs << (differs.empty() ? "" : "; ") << "the controller's TCP is at " << place(p)
          << ", the model's at the flange";
  if (angle > kTipAngle_rad)
    differs << "; it is turned by " << rounded(angle)
            << " rad, which tool_tip cannot state and would undo";
  keys << (keys.empty() ? "" : ", ") << "tool_tip = " << numbers(p, " ");
}

/// False for what no robot carries: the keys of [robot] have ranges.
bool can_be_stated(const UrState& state) {
  const auto far = [](const Vector3& p) { return p.cwiseAbs().maxCoeff() > Tool::kFarthest_m; };
  return !(state.payload_kg < 0.0 || state.payload_kg > Tool::kMostMass_kg ||
           far(state.payload_com) || far(state.tcp_offset.head<3>()));
}

/// The reported tip and the computed one, and how far the former is from the latter.
struct Tips {
  Pose said, model;
  double distance_m, angle_rad;
};

Tips tips_of(const UrState& state, const Pose& tcp) {
  JacobianOf<Robot> jacobian;
  Tips tips{pose_of(state.tcp_pose),
            forward_kinematics<Robot>(joint_trig<Robot>(state.q), tcp, jacobian), 0.0, 0.0};
  tips.distance_m = (tips.said.p - tips.model.p).norm();
  tips.angle_rad = log_so3(tips.model.r.conjugate() * tips.said.r).norm();
  return tips;
}

Message apart(const Tips& tips) {
  Message text;
  text << rounded(tips.distance_m) << " m and " << rounded(tips.angle_rad) << " rad";
  return text;
}

void describe(const Tips& tips, double tip_tolerance_m, Message& why) {
  why = Message("the controller has the tip at ");
  why << place(tips.said.p) << ", the model of a " << Robot::kName << " at " << place(tips.model.p)
      << ", " << apart(tips) << " apart; limits " << tip_tolerance_m
      << " m ([ur] tip_tolerance) and " << kTipAngle_rad << " rad";
}

/// The difference may be a TCP that the controller software does not report.
void suggest_tip(const Tips& tips, Message& why) {
  const Vector3 offset = tips.model.r.conjugate() * (tips.said.p - tips.model.p);
  why << "; this software tells no TCP; if the pendant has this one";
  if (tips.angle_rad > kTipAngle_rad) why << ", turned as tool_tip cannot state";
  why << ", add to [robot]: tool_tip = " << numbers(offset, " ")
      << "; else the arm is no UR10 of a CB3";
}

/// NaN is not within any tolerance.
Status check_tip(const UrState& state, const Tcp& tcp, double tip_tolerance_m, Message& why) {
  const Tips tips = tips_of(state, tcp.frame);
  if (tips.distance_m <= tip_tolerance_m && tips.angle_rad <= kTipAngle_rad) return Status::kOk;
  describe(tips, tip_tolerance_m, why);
  if (tcp.known)
    why << "; is the arm a UR10 of a CB3? Its own calibration is taken by scripts/robot-calibrate";
  else
    suggest_tip(tips, why);
  return tcp.known ? Status::kMismatch : Status::kMissingKey;
}

}  // namespace

Status check_before_program(const Tool& given, const UrState& state, double tip_tolerance_m,
                            Message& why) {
  Message differs, keys;
  if (!gives_payload(given)) compare_payload(state, differs, keys);
  if (gives_payload(given) && given.com.hasNaN()) compare_com(state, differs, keys);
  if (!gives_tcp(given)) compare_tcp(state, differs, keys);
  if (!keys.empty()) {
    why = differs;
    if (can_be_stated(state))
      why << "; add to [robot]: " << keys;
    else
      why << "; [robot] cannot state that, correct it on the pendant";
    return Status::kMissingKey;
  }
  const Tcp tcp = reported(state);
  if (gives_tcp(given) && !tcp.known) return Status::kOk;  // it is known when the program runs
  return check_tip(state, tcp, tip_tolerance_m, why);
}

Message tip_distance(const UrState& state) {
  const Tcp tcp = reported(state);
  return tcp.known && state.running() ? apart(tips_of(state, tcp.frame)) : Message();
}

Status check_with_program(const Tool& given, const UrState& state, double tip_tolerance_m,
                          Message& why) {
  const Tcp tcp = gives_tcp(given) ? Tcp{given.tip, true} : reported(state);
  return check_tip(state, tcp, tip_tolerance_m, why);
}

}  // namespace tactus::ur
