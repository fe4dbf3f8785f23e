// Pipeline: the chain of blocks that a file describes, in fixed memory. The types are fixed here,
// the composition is read at load, and nothing is decided in the cycle.
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
#include "kernel/pipeline/recorder.hpp"
#include "kernel/pipeline/schedule.hpp"
#include "kernel/pipeline/settings.hpp"
#include "kernel/pipeline/timing.hpp"
#include "kernel/reference/generator/frame.hpp"
#include "kernel/reference/generator/joint_reference_generator.hpp"
#include "kernel/reference/generator/task_reference_generator.hpp"

namespace tactus {

/// All kinds of block: a new controller is one line here. Each has its word in "type = ..." as
/// kType.
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
  Collision collision_check;  ///< a row of the schedule if the file has the section
  TaskLimits task_limits;
  ExecutiveSection executive;
  RecorderSection recorder;
  Recording recording;
  PortTable ports;
  Schedule schedule;  ///< the control chain, then the rows that the pipeline has
  bool takes_joints = false, takes_poses = false;  ///< spaces of its generators' references

  /// Lists the sections of a file that are not blocks; a board adds its own.
  template <class Visitor>
  void describe(Visitor& visit) {
    visit.section("robot", robot);
    visit.section("guard", guard);
    visit.section("collision", collision);
    visit.section("task_limits", task_limits);
    visit.section("executive", executive);
    visit.section("recorder", recorder);
  }

  /// Returns an empty slot at the end of the chain for the block of a section, or null if all slots
  /// are taken. [init]
  Block* append(const Name& section) {
    if (count_ == kMaxBlocks) return nullptr;
    names_[static_cast<std::size_t>(count_)] = section;
    return &blocks_[static_cast<std::size_t>(count_++)];
  }
  int count() const { return count_; }
  /// Name of the section of a block.
  const Name& name(int block) const { return names_[static_cast<std::size_t>(block)]; }

  /// Starts every block in order, from the measured state, and checks that state for collisions.
  /// Returns the first Status that is not kOk. [init]
  Status start(const RobotState& measured);
  /// Steps every block in order and times each. Returns the first Status that is not kOk. [cyclic]
  Status step(const RobotState& measured, Timing* timing = nullptr);
  /// True if no block has a motion of its own that goes on: see kernel/core/brake.hpp.
  /// [between two cycles]
  bool at_rest() const;
  /// Lets every block go on after a brake that has come to rest: see kernel/core/brake.hpp. [init]
  Status resume(const RobotState& measured);
  /// Ends the own motion of every block: see kernel/core/brake.hpp. [cyclic]
  void brake(Status why, BrakeWay way);
  /// Returns the deceleration of every joint in a brake at once, rad/s^2: the guard's limit, or a
  /// block's own. [init]
  JointVector deceleration() const;

 private:
  template <class Act>
  Status for_each_block(Act act);

  std::array<Name, kMaxBlocks> names_;
  std::array<Block, kMaxBlocks> blocks_;
  int count_ = 0;
};

static_assert(std::is_trivially_destructible_v<Pipeline>,
              "a pipeline owns nothing but its own bytes");

}  // namespace tactus
