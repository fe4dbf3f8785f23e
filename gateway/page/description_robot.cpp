#include "gateway/page/description.hpp"
#include "kernel/robots/robot.hpp"

namespace tactus {
namespace {

void frame(const JointFrame& given, Json& to) {
  to.open('[').number(given.x).number(given.y).number(given.z);
  to.integer(given.roll_quarter_turns).close(']');
}

void joints(const JointLimits& limits, Json& to) {
  to.open('[', "joints");
  for (int i = 0; i < kDof; ++i) {
    to.open('{').string(Robot::kJointNames[static_cast<std::size_t>(i)], "name");
    to.number(limits.q_min[i], "min").number(limits.q_max[i], "max");
    to.number(limits.dq_max[i], "velocity").number(limits.tau_max[i], "effort").close('}');
  }
  to.close(']');
}

}  // namespace

void describe_robot(const Pipeline& pipeline, Json& to) {
  joints(pipeline.guard.references(), to);
  to.open('[', "frames");
  for (const JointFrame& joint : Robot::kJoints) frame(joint, to);
  to.close(']').open('[', "flange_frames");
  frame(Robot::kFlange, to);
  to.close(']').numbers("tip", pipeline.robot.tool_tip.data(), 3).open('[', "capsules");
  for (const LinkCapsule& capsule : RobotCapsules::kCapsules) {
    to.open('{').integer(capsule.link, "link").numbers("a", capsule.a, 3);
    to.numbers("b", capsule.b, 3).number(capsule.radius, "radius").close('}');
  }
  to.close(']');
}

void describe_page(const PageSubject& subject, std::string_view token, Json& to) {
  to.open('{').string(token, "token").string(Robot::kName, "robot");
  to.string(subject.board, "board").string(subject.file, "pipeline");
  to.flag(subject.simulated, "simulated");
  to.number(subject.pipeline.robot.period_s(), "period_s");
  describe_robot(subject.pipeline, to);
  describe_blocks(subject.pipeline, to);
  to.close('}');
}

}  // namespace tactus
