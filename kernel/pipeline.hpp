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
#include "kernel/guard/collision.hpp"
#include "kernel/guard/guard.hpp"
#include "kernel/model/robot_model.hpp"
#include "kernel/recorder.hpp"
#include "kernel/reference/frame.hpp"
#include "kernel/reference/joint_reference_generator.hpp"
#include "kernel/reference/task_reference_generator.hpp"
#include "kernel/schedule.hpp"
#include "kernel/settings.hpp"
#include "kernel/timing.hpp"

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

class Pipeline {
 public:
  RobotSection robot;
  Guard::Params guard;
  CollisionSection collision;
  Collision collision_check;  ///< a row of the schedule where the file has the section
  TaskLimits task_limits;
  ExecutiveSection executive;
  RecorderSection recorder;
  Recording recording;
  PortTable ports;
  Schedule schedule;  ///< the control chain, then the rows that the pipeline has
  bool takes_joints = false, takes_poses = false;  ///< which references its generators take

  /// An empty slot at the end of the chain for the block of a section, or null if all are taken.
  /// [init]
  Block* append(const Name& section) {
    if (count_ == kMaxBlocks) return nullptr;
    names_[static_cast<std::size_t>(count_)] = section;
    return &blocks_[static_cast<std::size_t>(count_++)];
  }
  int count() const { return count_; }
  /// The section of a block.
  const Name& name(int block) const { return names_[static_cast<std::size_t>(block)]; }

  /// Starts every block in order, from the measured state. The first Status that is not kOk. [init]
  Status start(const RobotState& measured);
  /// Steps every block in order, and times each. The first Status that is not kOk. [cyclic]
  Status step(const RobotState& measured, Timing* timing = nullptr);
  /// Every block ends its own motion: see kernel/brake.hpp. [cyclic]
  void brake(Status why, BrakeWay way);
  /// What every joint brakes with at once, rad/s^2: the guard's limit, or a block's own. [init]
  JointVector deceleration() const;

 private:
  std::array<Name, kMaxBlocks> names_;
  std::array<Block, kMaxBlocks> blocks_;
  int count_ = 0;
};

static_assert(std::is_trivially_destructible_v<Pipeline>,
              "a pipeline owns nothing but its own bytes");

}  // namespace tactus
