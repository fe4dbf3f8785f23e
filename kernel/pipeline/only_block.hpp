// only_block: finds the block that a request without a name means.
#pragma once

#include <type_traits>

#include "kernel/pipeline/with_block.hpp"

namespace tactus {

/// Returns the number of the only block of this kind; -1: there is none, or more than one. [init]
template <class Kind>
int only_block(const Pipeline& pipeline) {
  int found = -1, count = 0;
  for (int i = 0; i < pipeline.count(); ++i) {
    with_kind(pipeline[i].kind, [&](auto kind) {
      if constexpr (std::is_same_v<typename decltype(kind)::Type, Kind>) {
        found = i;
        ++count;
      }
    });
  }
  return count == 1 ? found : -1;
}

}  // namespace tactus
