// The motion commands of URScript with their arguments.
#include "sim_plant/ur/script/script_motion.hpp"

#include <algorithm>

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

/// Returns the joints of an argument that is a list, or finds those of a pose.
bool joints_of(const ScriptValue* value, const Machine& machine, Joints& q) {
  if (value == nullptr || !value->six()) return false;
  q = value->vector();
  if (value->kind == Kind::kList) return true;
  const Joints near = machine.motion.q();
  return inverse(Frame::of(value->vector()), machine.motion.tool(), near, q);
}

Frame frame_of(const ScriptValue& value, const Machine& machine) {
  if (value.kind == Kind::kPose) return Frame::of(value.vector());
  return forward(value.vector()) * machine.motion.tool();
}

CallResult move_j(const ScriptCall& call, Machine& machine) {
  Joints q;
  if (!joints_of(call.find("q", 0), machine, q)) return CallResult::kNoReach;
  const bool good = machine.motion.move_j(q, call.number("a", 1, 0.0), call.number("v", 2, 0.0),
                                          call.number("t", 3, 0.0), call.number("r", 4, 0.0));
  return good ? CallResult::kMotion : CallResult::kNoReach;
}

/// Runs movel(pose, a, v, t, r), movep(pose, a, v, r), movec(pose_via, pose_to, a, v, r, mode), and
/// servoc(pose, a, v, r) as a movep.
CallResult move_tool(const ScriptCall& call, Machine& machine) {
  Move move;
  move.kind = call.name == "movel"   ? Move::Kind::kL
              : call.name == "movec" ? Move::Kind::kC
                                     : Move::Kind::kP;
  const bool line = move.kind == Move::Kind::kL, arc = move.kind == Move::Kind::kC;
  const std::size_t first = arc ? 1 : 0;
  const ScriptValue* via = call.find("pose_via", 0);
  const ScriptValue* pose = call.find(arc ? "pose_to" : "pose", first);
  if (pose == nullptr || !pose->six() || (arc && (via == nullptr || !via->six())))
    return CallResult::kNoReach;
  move.target = frame_of(*pose, machine);
  if (arc) move.via = frame_of(*via, machine);
  move.fixed = arc && call.number("mode", 5, 0.0) == 1.0;
  move.a = call.number("a", first + 1, 0.0);
  move.v = call.number("v", first + 2, 0.0);
  if (line) move.t = call.number("t", 3, 0.0);
  move.r = call.number("r", line ? 4 : first + 3, 0.0);
  if (machine.motion.move(move)) return CallResult::kMotion;
  machine.protective_stop({Code::kSingularity, 0});
  return CallResult::kHalt;
}

CallResult servo_j(const ScriptCall& call, Machine& machine) {
  const ScriptValue* q = call.find("q", 0);
  if (q == nullptr || !q->six()) return CallResult::kDone;
  ServoLaw law;
  law.lookahead_s = call.number("lookahead_time", 4, law.lookahead_s);
  law.gain = call.number("gain", 5, law.gain);
  machine.motion.servo_j(q->vector(), call.number("t", 3, machine.cycle_s()), law);
  return CallResult::kMotion;
}

CallResult speed(const ScriptCall& call, bool joints, Machine& machine) {
  const ScriptValue* goal = call.find(joints ? "qd" : "xd", 0);
  if (goal == nullptr || !goal->six()) return CallResult::kDone;
  const double a = call.number("a", 1, 0.0), t = call.number("t", 2, call.number("t_min", 2, 0.0));
  if (joints)
    machine.motion.speed_j(goal->vector(), a, t);
  else
    machine.motion.speed_l(goal->vector(), a, t);
  return CallResult::kMotion;
}

}  // namespace

bool is_motion(std::string_view name) {
  constexpr std::string_view kNames[] = {"movej",  "movel",  "movep",  "movec", "servoj",
                                         "servoc", "speedj", "speedl", "stopj", "stopl"};
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

CallResult run_motion(const ScriptCall& call, Machine& machine) {
  if (call.name == "movej") return move_j(call, machine);
  if (call.name == "servoj") return servo_j(call, machine);
  if (call.name == "speedj") return speed(call, true, machine);
  if (call.name == "speedl") return speed(call, false, machine);
  if (!starts_with(call.name, "stop")) return move_tool(call, machine);
  machine.motion.stop_j(call.number("a", 0, 0.0));
  return CallResult::kMotion;
}

}  // namespace tactus::ur
