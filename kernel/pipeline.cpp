#include "kernel/pipeline.hpp"

#include "kernel/loop_bound.hpp"

namespace tactus {

/// One step of a block: of every kind a function with a name of its own, by which profiles and
/// bounds go.
template <class Kind>
[[gnu::noinline]] Status step_block(Kind& block, double period_s) {
  return block.step(period_s);
}

namespace {

/// A block whose settings are to be judged by the period takes it.
template <class Kind>
Status start_block(Kind& block, double period_s) {
  if constexpr (std::is_invocable_v<decltype(&Kind::start), Kind&, double>)
    return block.start(period_s);
  else
    return block.start();
}

}  // namespace

Status Pipeline::start(const RobotState& measured) {
  robot.set_measured(measured);
  robot.tool.value = {robot.tool_mass, robot.tool_com, Pose{robot.tool_tip, {1.0, 0.0, 0.0, 0.0}}};
  for (int i = 0; i < count_; ++i) {
    TRY(std::visit(
        [this](auto& block) {
          if constexpr (std::is_same_v<decltype(block), std::monostate&>)
            return Status::kOk;
          else
            return start_block(block, robot.period_s());
        },
        blocks_[static_cast<std::size_t>(i)]));
  }
  collision_check.start(collision, guard.effective(), robot.tool_tip, robot.period_s());
  return Status::kOk;
}

Status Pipeline::step(const RobotState& measured, Timing* timing) {
  robot.set_measured(measured);
  const double period_s = robot.period_s();
  LoopBound<kMaxBlocks> steps;
  for (int i = 0; i < count_; ++i) {
    steps.tick();
    TRY(std::visit(
        [period_s](auto& block) {
          if constexpr (std::is_same_v<decltype(block), std::monostate&>)
            return Status::kOk;
          else
            return step_block(block, period_s);
        },
        blocks_[static_cast<std::size_t>(i)]));
    if (timing != nullptr) timing->lap_block(i);
  }
  return Status::kOk;
}

void Pipeline::brake(Status why, BrakeWay way) {
  LoopBound<kMaxBlocks> brakes;
  for (int i = 0; i < count_; ++i) {
    brakes.tick();
    std::visit(
        [why, way](auto& block) {
          if constexpr (!std::is_same_v<decltype(block), std::monostate&>) block.brake(why, way);
        },
        blocks_[static_cast<std::size_t>(i)]);
  }
}

JointVector Pipeline::deceleration() const {
  JointVector least = guard.limits.ddq_max;
  for (const Block& block : blocks_)
    if (const auto* law = std::get_if<CartesianPose>(&block))
      least = least.cwiseMin(law->params.limits.ddq_max);
  return least;
}

}  // namespace tactus
