// Pipeline: the chain of blocks that a file describes, in fixed memory. The types are fixed in
// kinds.hpp, the composition is read at load, and nothing is decided in the cycle.
#pragma once

#include <array>
#include <type_traits>

#include "kernel/core/arena.hpp"
#include "kernel/core/brake.hpp"
#include "kernel/core/task_limits.hpp"
#include "kernel/guard/collision.hpp"
#include "kernel/guard/guard.hpp"
#include "kernel/pipeline/recorder.hpp"
#include "kernel/pipeline/schedule.hpp"
#include "kernel/pipeline/settings.hpp"
#include "kernel/pipeline/timing.hpp"
#include "kernel/pipeline/tuning.hpp"
#include "kernel/streams/generator_streams.hpp"

namespace tactus {

/// A block of the chain: a kind of Kinds, at its place in the board's memory.
struct Block {
  Name name;  ///< of its section
  std::size_t kind = 0;
  void* place = nullptr;
};

class Pipeline {
 public:
  /// Places the blocks in `size` bytes at `bytes`, which the board owns and which are aligned as
  /// `std::max_align_t` is. [init]
  [[gnu::cold]] Pipeline(std::byte* bytes, std::size_t size) : memory(bytes, size) {}
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

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
  std::uint8_t failed = 0;       ///< the last block whose start() or step() was not kOk
  Status failure = Status::kOk;  ///< what that was, since start() or resume()
  Arena memory;                  ///< what is left for further blocks

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

  /// Appends a block that the loader has placed in `memory`; there are fewer than kMaxBlocks.
  /// [init]
  void append(const Block& block) { blocks_[static_cast<std::size_t>(count_++)] = block; }
  int count() const { return count_; }
  /// Name of the section of a block.
  const Name& name(int block) const { return (*this)[block].name; }
  const Block& operator[](int block) const { return blocks_[static_cast<std::size_t>(block)]; }

  /// Starts every block in order, from the measured state, and checks that state for collisions.
  /// Returns the first Status that is not kOk. [init]
  [[gnu::cold]] Status start(const RobotState& measured);
  /// Steps every block in order and times each. Returns the first Status that is not kOk. [cyclic]
  Status step(const RobotState& measured, Timing* timing = nullptr);
  /// True if no block has a motion of its own that continues: see kernel/core/brake.hpp.
  /// [between two cycles]
  bool at_rest() const;
  /// Returns the motion state of the last reference generator of the chain. [between two
  /// cycles]
  MotionState motion_state() const;
  /// Resumes every block after a brake that has come to rest: see kernel/core/brake.hpp. [init]
  [[gnu::cold]] Status resume(const RobotState& measured);
  /// Changes the parameters of all blocks of which `tuning` has a copy, or of none: the first block
  /// that refuses is in the verdict. While the chain `runs`, no command steps
  /// (kernel/math/bumpless_transfer.hpp), and a law may refuse what it would command; otherwise the
  /// next start() begins with the new parameters. [between two cycles]
  TuningVerdict retune(const Tuning& tuning, bool runs);
  /// Ends the own motion of every block: see kernel/core/brake.hpp. [cyclic]
  void brake(Status why, BrakeWay way);
  /// Sets the limits of references in every block that moves the joints by itself. [init]
  [[gnu::cold]] void keep_within(const JointLimits& limits);
  /// Returns the deceleration of every joint in a brake at once, rad/s^2: the guard's limit, or a
  /// block's own. [init]
  [[gnu::cold]] JointVector deceleration() const;
  /// Returns the joint positions that the command follows, rad: those of the robot's own servo, or
  /// of the law that gives the torque; null if there are none. [init]
  [[gnu::cold]] const JointVector* reference() const;

 private:
  template <class Act>
  Status for_each_block(Act act);
  Status note(int block, Status status);

  std::array<Block, kMaxBlocks> blocks_;
  int count_ = 0;
};

/// A pipeline with `kBytes` for its blocks, which take the sizes of their kinds
/// (docs/memory.md); a file whose blocks need more is refused.
template <std::size_t kBytes>
class PipelineMemory : public Pipeline {
 public:
  PipelineMemory() : Pipeline(bytes_, kBytes) {}

 private:
  alignas(std::max_align_t) std::byte bytes_[kBytes];
};

/// For a board that has memory enough: it holds the blocks of any file.
using RoomyPipeline = PipelineMemory<std::size_t{64} << 10>;

static_assert(std::is_trivially_destructible_v<Pipeline>,
              "a pipeline owns nothing but its own bytes");

}  // namespace tactus
