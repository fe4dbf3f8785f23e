// Pipeline: the chain of blocks that a file describes, in fixed memory. Types closed here,
// composition open at load, nothing decided in the cycle.
#pragma once

#include <array>
#include <type_traits>
#include <variant>

#include "kernel/control/admittance.hpp"
#include "kernel/control/cartesian_pose.hpp"
#include "kernel/control/pd_gravity.hpp"
#include "kernel/control/pid.hpp"
#include "kernel/control/wrench_front_end.hpp"
#include "kernel/guard/box_obstacle.hpp"
#include "kernel/guard/collision_section.hpp"
#include "kernel/guard/guard.hpp"
#include "kernel/model/robot_model.hpp"
#include "kernel/recorder.hpp"
#include "kernel/reference/frame.hpp"
#include "kernel/reference/joint_reference_generator.hpp"
#include "kernel/reference/task_reference_generator.hpp"
#include "kernel/settings.hpp"

namespace tactus {

/// Every kind of block there is: adding a controller is one line here. Each says the word for it
/// in "type = ..." as kType.
using Block = std::variant<std::monostate,           //
                           RobotModel,               //
                           Frame,                    //
                           BoxObstacle,              //
                           JointReferenceGenerator,  //
                           TaskReferenceGenerator,   //
                           PdGravity,                //
                           Pid,                      //
                           WrenchFrontEnd,           //
                           Admittance,               //
                           CartesianPose>;

template <class... Blocks>
constexpr std::array<const char*, 1 + sizeof...(Blocks)> block_types(
    const std::variant<std::monostate, Blocks...>*) {
  return {"", Blocks::kType...};
}

/// The word for each kind, in the order of Block.
inline constexpr std::array<const char*, std::variant_size_v<Block>> kBlockTypes =
    block_types(static_cast<const Block*>(nullptr));

inline constexpr int kMaxBlocks = 12;

class Pipeline {
 public:
  RobotSection robot;
  Guard::Params guard;
  CollisionSection collision;
  TaskLimits task_limits;
  ExecutiveSection executive;
  RecorderSection recorder;
  Recording recording;
  PortTable ports;
  bool takes_joints = false, takes_poses = false;  ///< which references its generators take

  /// An empty slot at the end of the chain, or null if all are taken. [init]
  Block* append() {
    return count_ < kMaxBlocks ? &blocks_[static_cast<std::size_t>(count_++)] : nullptr;
  }

  /// Starts every block in order, from the measured state. The first Status that is not kOk. [init]
  Status start(const RobotState& measured);
  /// Steps every block in order. The first Status that is not kOk. [cyclic]
  Status step(const RobotState& measured);

 private:
  std::array<Block, kMaxBlocks> blocks_;
  int count_ = 0;
};

static_assert(std::is_trivially_destructible_v<Pipeline>,
              "a pipeline owns nothing but its own bytes");

}  // namespace tactus
