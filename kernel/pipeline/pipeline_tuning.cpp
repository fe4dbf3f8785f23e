// Pipeline: parameters that change while it runs.
#include "kernel/pipeline/with_block.hpp"

namespace tactus {
namespace {

template <class Kind, class = void>
constexpr bool kJudgesChange = false;
template <class Kind>
constexpr bool kJudgesChange<Kind, std::void_t<decltype(&Kind::judge_change)>> = true;

template <class Kind>
const auto& new_params(const Kind& /*block*/, const void* copy) {
  return static_cast<const Kind*>(copy)->params;
}

template <class Kind>
Verdict judge(const Kind& block, const void* copy, const JointLimits& limits) {
  if constexpr (kJudgesChange<Kind>) return block.judge_change(new_params(block, copy), limits);
  return {};
}

template <class Kind>
void change(Kind& block, const void* copy, bool runs, const JointLimits& limits) {
  if constexpr (kTunes<Kind>) {
    if (runs)
      block.retune(new_params(block, copy), limits);
    else
      block.params = new_params(block, copy);
  }
}

}  // namespace

TuningVerdict Pipeline::retune(const Tuning& tuning, bool runs) {
  for (int i = 0; i < count_ && runs; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (tuning.copies[at] == nullptr) continue;
    const Verdict verdict = with_block(blocks_[at], [&](const auto& block) {
      return judge(block, tuning.copies[at], guard.limits);
    });
    if (verdict.status != Status::kOk) return {verdict, i};
  }
  for (int i = 0; i < count_; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (tuning.copies[at] == nullptr) continue;
    with_block(blocks_[at],
               [&](auto& block) { change(block, tuning.copies[at], runs, guard.limits); });
  }
  return {};
}

}  // namespace tactus
