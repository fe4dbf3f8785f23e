// Pipeline: parameters that change while it runs.
#include "kernel/pipeline/with_block.hpp"

namespace tactus {
namespace {

template <class Kind, class = void>
constexpr bool kJudgesChange = false;
template <class Kind>
constexpr bool kJudgesChange<Kind, std::void_t<decltype(&Kind::judge_change)>> = true;

/// Visits the description of a kind that does not change while it runs.
struct Untuned {
  template <class... Any>
  void param(Any&&...) {}
  template <class... Any>
  void limit(Any&&...) {}
  template <class... Any>
  void text(Any&&...) {}
  template <class... Any>
  void choice(Any&&...) {}
  template <class... Any>
  void in(Any&&...) {}
  template <class... Any>
  void optional(Any&&...) {}
  template <class... Any>
  void out(Any&&...) {}
  template <class... Any>
  void channel(Any&&...) {}
  template <class Value>
  void tunable(const char*, Value&, const Range&, const char*) {
    static_assert(sizeof(Value) == 0, "a kind with a tunable parameter has retune(); else: param");
  }
};

/// True if it compiles: no kind offers parameters that it cannot change.
template <auto>
constexpr bool kCompiles = true;
template <class Kind>
constexpr bool changes_what_it_offers() {
  if constexpr (kTunes<Kind>)
    return true;
  else
    return kCompiles<&Kind::template describe<Untuned>>;
}
template <class... Each>
constexpr bool all_change_what_they_offer(KindList<Each...>) {
  return (... && changes_what_it_offers<Each>());
}
static_assert(all_change_what_they_offer(Kinds()));

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
