#include "kernel/pipeline/pipeline.hpp"

#include "kernel/core/loop_bound.hpp"
#include "kernel/pipeline/with_block.hpp"

namespace tactus {

/// Steps one block. Each kind has its own function with its own name, which profiles and bounds
/// use.
template <class Kind>
[[gnu::noinline]] Status step_block(Kind& block, double period_s) {
  return block.step(period_s);
}

namespace {

/// Starts one block; start() takes the period if the block checks its settings against it.
template <class Kind>
Status start_block(Kind& block, double period_s) {
  if constexpr (std::is_invocable_v<decltype(&Kind::start), Kind&, double>)
    return block.start(period_s);
  else
    return block.start();
}

template <class Kind, class = void>
constexpr bool kResumes = false;
template <class Kind>
constexpr bool kResumes<Kind, std::void_t<decltype(&Kind::resume)>> = true;

template <class Kind, class = void>
constexpr bool kMoves = false;
template <class Kind>
constexpr bool kMoves<Kind, std::void_t<decltype(&Kind::at_rest)>> = true;

template <class Kind, class = void>
constexpr bool kGenerates = false;
template <class Kind>
constexpr bool kGenerates<Kind, std::void_t<decltype(&Kind::motion_state)>> = true;

template <class Kind, class = void>
constexpr bool kLimitsBraking = false;
template <class Kind>
constexpr bool kLimitsBraking<Kind, std::void_t<decltype(&Kind::deceleration)>> = true;

template <class Kind, class = void>
constexpr bool kKeepsJoints = false;
template <class Kind>
constexpr bool kKeepsJoints<Kind, std::void_t<decltype(&Kind::keep_within)>> = true;

/// A block whose command must not step has a resume(); the others restart.
template <class Kind>
Status resume_block(Kind& block, double period_s) {
  if constexpr (kResumes<Kind>)
    return block.resume();
  else
    return start_block(block, period_s);
}

}  // namespace

/// Calls act(block) for every block in order. Returns the first Status that is not kOk.
template <class Act>
Status Pipeline::for_each_block(Act act) {
  for (int i = 0; i < count_; ++i)
    TRY(note(i, with_block(blocks_[static_cast<std::size_t>(i)], act)));
  return Status::kOk;
}

/// Notes the block that ends a pass.
Status Pipeline::note(int block, Status status) {
  if (status == Status::kOk) return status;
  failed = static_cast<std::uint8_t>(block);
  return failure = status;
}

Status Pipeline::start(const RobotState& measured) {
  failure = Status::kOk;
  robot.set_measured(measured);
  TRY(for_each_block([this](auto& block) { return start_block(block, robot.period_s()); }));
  collision_check.start(collision, guard.effective(), robot.tool.value.tip.p, robot.period_s(),
                        reference());
  return collision.present ? collision_check.check(measured, robot.tool.value.gravity)
                           : Status::kOk;
}

bool Pipeline::at_rest() const {
  bool rests = true;
  for (int i = 0; i < count_; ++i) {
    with_block(blocks_[static_cast<std::size_t>(i)], [&rests](const auto& block) {
      if constexpr (kMoves<std::decay_t<decltype(block)>>) rests = rests && block.at_rest();
    });
  }
  return rests;
}

MotionState Pipeline::motion_state() const {
  MotionState state;
  for (int i = 0; i < count_; ++i) {
    with_block(blocks_[static_cast<std::size_t>(i)], [&state](const auto& block) {
      if constexpr (kGenerates<std::decay_t<decltype(block)>>) state = block.motion_state();
    });
  }
  return state;
}

const JointVector* Pipeline::reference() const {
  const JointVector* found = robot.q_c.wired() ? robot.q_c.source : nullptr;
  for (int i = 0; i < count_; ++i) {
    with_block(blocks_[static_cast<std::size_t>(i)], [&](const auto& block) {
      if constexpr (kIsTorqueLaw<std::decay_t<decltype(block)>>)
        if (&block.tau.value == robot.tau_c.source) found = block.q_d.source;
    });
  }
  return found;
}

Status Pipeline::resume(const RobotState& measured) {
  failure = Status::kOk;
  robot.set_measured(measured);
  TRY(for_each_block([this](auto& block) { return resume_block(block, robot.period_s()); }));
  collision_check.begin_anew();
  return Status::kOk;
}

Status Pipeline::step(const RobotState& measured, Timing* timing) {
  robot.set_measured(measured);
  const double period_s = robot.period_s();
  LoopBound<kMaxBlocks> steps;
  for (int i = 0; i < count_; ++i) {
    steps.tick();
    TRY(note(i, with_block(blocks_[static_cast<std::size_t>(i)],
                           [period_s](auto& block) { return step_block(block, period_s); })));
    if (timing != nullptr) timing->lap_block(i);
  }
  return Status::kOk;
}

void Pipeline::brake(Status why, BrakeWay way) {
  LoopBound<kMaxBlocks> brakes;
  for (int i = 0; i < count_; ++i) {
    brakes.tick();
    with_block(blocks_[static_cast<std::size_t>(i)],
               [why, way](auto& block) { block.brake(why, way); });
  }
}

void Pipeline::keep_within(const JointLimits& limits) {
  for (int i = 0; i < count_; ++i) {
    with_block(blocks_[static_cast<std::size_t>(i)], [&limits](auto& block) {
      if constexpr (kKeepsJoints<std::decay_t<decltype(block)>>) block.keep_within(limits);
    });
  }
}

JointVector Pipeline::deceleration() const {
  JointVector least = guard.limits.ddq_max;
  for (int i = 0; i < count_; ++i) {
    with_block(blocks_[static_cast<std::size_t>(i)], [&least](const auto& block) {
      if constexpr (kLimitsBraking<std::decay_t<decltype(block)>>)
        least = least.cwiseMin(block.deceleration());
    });
  }
  return least;
}

}  // namespace tactus
