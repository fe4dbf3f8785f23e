#include "kernel/pipeline.hpp"

namespace tactus {

Status Pipeline::start(const RobotState& measured) {
  robot.set_measured(measured);
  robot.tool.value = {robot.tool_mass, robot.tool_com, Pose{robot.tool_tip, {1.0, 0.0, 0.0, 0.0}}};
  for (int i = 0; i < count_; ++i) {
    TRY(std::visit(
        [](auto& block) {
          if constexpr (std::is_same_v<decltype(block), std::monostate&>)
            return Status::kOk;
          else
            return block.start();
        },
        blocks_[static_cast<std::size_t>(i)]));
  }
  return Status::kOk;
}

Status Pipeline::step(const RobotState& measured) {
  robot.set_measured(measured);
  const double period_s = robot.period_s();
  for (int i = 0; i < count_; ++i) {
    TRY(std::visit(
        [period_s](auto& block) {
          if constexpr (std::is_same_v<decltype(block), std::monostate&>)
            return Status::kOk;
          else
            return block.step(period_s);
        },
        blocks_[static_cast<std::size_t>(i)]));
  }
  return Status::kOk;
}

}  // namespace tactus
