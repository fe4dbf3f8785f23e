// with_block: visits a block of a pipeline as its own kind.
#pragma once

#include "kernel/pipeline/kinds.hpp"
#include "kernel/pipeline/pipeline.hpp"

namespace tactus {

/// Returns act(block) with the block as its own kind. [any]
template <class Act>
auto with_block(const Block& block, Act&& act) {
  return with_kind(block.kind, [&](auto kind) {
    return act(*static_cast<typename decltype(kind)::Type*>(block.place));
  });
}

/// True for a kind with parameters that may change while it runs.
template <class Kind, class = void>
inline constexpr bool kTunes = false;
template <class Kind>
inline constexpr bool kTunes<Kind, std::void_t<decltype(&Kind::retune)>> = true;

}  // namespace tactus
