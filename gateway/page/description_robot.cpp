#include <type_traits>

#include "gateway/page/description.hpp"
#include "kernel/pipeline/kinds.hpp"
#include "kernel/robots/robot.hpp"

namespace tactus {
namespace {

void frame(const JointFrame& given, Json& to) {
  to.open('[').number(given.x).number(given.y).number(given.z);
  to.number(given.roll()).number(given.turn);
  to.integer(given.type == JointType::kPrismatic ? 1 : 0).close(']');
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

/// Calls act(block) for every block of one kind.
template <class Kind, class Act>
void for_each(Pipeline& pipeline, const Act& act) {
  for (int i = 0; i < pipeline.count(); ++i) {
    with_kind(pipeline[i].kind, [&](auto kind) {
      if constexpr (std::is_same_v<typename decltype(kind)::Type, Kind>)
        act(pipeline[i].name, *static_cast<Kind*>(pipeline[i].place));
    });
  }
}

/// The corner whose number has bit k is on the far side along axis k.
void corners(const Cuboid& box, Json& to) {
  to.open('[', "corners");
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vector3 at = box.size / 2.0;
    for (unsigned k = 0; k < 3; ++k)
      if ((corner >> k & 1u) == 0) at[k] = -at[k];
    at = box.pose.p + box.pose.r * at;
    to.number(at.x()).number(at.y()).number(at.z());
  }
  to.close(']');
}

template <class Body>
void boxes_of(Pipeline& pipeline, Json& to) {
  for_each<Body>(pipeline, [&](const Name& name, Body& body) {
    bool constant = !body.frame.wired();
    for_each<Frame>(pipeline, [&](const Name&, const Frame& frame) {
      constant = constant || body.frame.source == &frame.x.value;
    });
    if (!constant || body.start() != Status::kOk) return;
    to.open('{').string(name, "name");
    corners(body.box.value, to);
    to.close('}');
  });
}

/// Constant frames and the bodies in them are placed as every arming places them; a body is shown
/// by its box. One in a frame that moves stays where that is at arming, which is not known yet.
void boxes(Pipeline& pipeline, Json& to) {
  for_each<Frame>(pipeline, [](const Name&, Frame& frame) { static_cast<void>(frame.start()); });
  to.open('[', "boxes");
  boxes_of<BoxObstacle>(pipeline, to);
  boxes_of<SphereObstacle>(pipeline, to);
  boxes_of<CapsuleObstacle>(pipeline, to);
  boxes_of<CylinderObstacle>(pipeline, to);
  boxes_of<ConvexObstacle>(pipeline, to);
  to.close(']');
}

}  // namespace

void describe_robot(Pipeline& pipeline, Json& to) {
  joints(pipeline.guard.references(), to);
  to.open('[', "frames");
  for (const JointFrame& joint : Robot::kJoints) frame(joint, to);
  to.close(']').open('[', "flange_frames");
  frame(Robot::kFlange, to);
  to.close(']')
      .numbers("tip", assumed(pipeline.robot.given_tool()).tip.p.data(), 3)
      .open('[', "capsules");
  for (const LinkCapsule& capsule : RobotCapsules::kCapsules) {
    to.open('{').integer(capsule.link, "link").numbers("a", capsule.a, 3);
    to.numbers("b", capsule.b, 3).number(capsule.radius, "radius").close('}');
  }
  to.close(']');
  boxes(pipeline, to);
}

void describe_page(const PageSubject& subject, std::string_view token, Json& to) {
  to.open('{').string(token, "token").string(Robot::kName, "robot");
  to.string(subject.board, "board").string(subject.file, "pipeline");
  to.flag(subject.simulated, "simulated");
  describe_robot(subject.pipeline, to);
  describe_blocks(subject.pipeline, to);
  to.close('}');
}

}  // namespace tactus
