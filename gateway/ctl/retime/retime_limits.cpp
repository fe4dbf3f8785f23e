#include "gateway/ctl/retime/retime_limits.hpp"

#include <robots.hpp>

#include "gateway/ctl/verbs.hpp"

namespace tactus::ctl {
namespace {

void resize_joints(RobotLimits& limits, Eigen::Index count) {
  MotionBounds& joint = limits.joint;
  for (Numbers* one : {&joint.v, &joint.a, &joint.j, &limits.lowest, &limits.highest})
    one->resize(count);
}

Numbers two(double translation, double rotation) {
  Numbers both(2);
  both << translation, rotation;
  return both;
}

template <class Robot>
void use_table(RobotLimits& limits) {
  limits.robot = Robot::kName;
  resize_joints(limits, Robot::kDof);
  for (std::size_t i = 0; i < Robot::kLimits.size(); ++i) {
    const JointLimit& limit = Robot::kLimits[i];
    const auto k = static_cast<Eigen::Index>(i);
    limits.joints.push_back({Robot::kJointNames[i], is_prismatic<Robot>(static_cast<int>(i))});
    limits.lowest[k] = limit.q_min;
    limits.highest[k] = limit.q_max;
    limits.joint.v[k] = limit.dq_max;
    limits.joint.a[k] = limit.ddq_max;
    limits.joint.j[k] = limit.dddq_max;
  }
  const TaskLimit& tip = Robot::kTaskLimit;
  limits.tip = {two(tip.v_max, tip.w_max), two(tip.a_max, tip.alpha_max),
                two(tip.j_max, tip.dalpha_max)};
}

int ask_server(const Options& options, Output& output, RobotLimits& limits) {
  Client client(options, output);
  if (!client.connect()) return client.exit_code();
  const Welcome& welcome = client.welcome();
  limits.robot = welcome.robot();
  limits.joints = joint_names(welcome);
  resize_joints(limits, welcome.joints_size());
  for (int k = 0; k < welcome.joints_size(); ++k) {
    const Joint& joint = welcome.joints(k);
    limits.lowest[k] = joint.min_rad();
    limits.highest[k] = joint.max_rad();
    limits.joint.v[k] = joint.velocity();
    limits.joint.a[k] = joint.acceleration();
    limits.joint.j[k] = joint.jerk();
  }
  const TaskLimits& tip = welcome.task();
  if (welcome.has_task())
    limits.tip = {two(tip.velocity(), tip.angular_velocity()),
                  two(tip.acceleration(), tip.angular_acceleration()),
                  two(tip.jerk(), tip.angular_jerk())};
  return kSucceeded;
}

}  // namespace

int find_limits(const Options& options, Output& output, RobotLimits& limits) {
  if (options.robot.empty() && !options.connect.empty()) return ask_server(options, output, limits);
  std::string known;
  const auto is_given = [&](auto robot) {
    using Robot = decltype(robot);
    known += (known.empty() ? "" : ", ") + std::string(Robot::kName);
    if (options.robot != Robot::kName) return false;
    use_table<Robot>(limits);
    return true;
  };
  if (any_robot(is_given)) return kSucceeded;
  output.error(options.robot.empty()
                   ? "retime needs limits; give --robot, one of " + known + ", or --connect"
                   : "--robot " + options.robot + ": unknown robot; expected one of " + known,
               kRefused);
  return kRefused;
}

}  // namespace tactus::ctl
