// Ports: the connections between blocks. An Out holds the value and belongs to the block that
// writes it; an In is a pointer to that value, bound once by the loader. The quantity is part of
// the type, so a velocity cannot be read as a position.
#pragma once

#include "kernel/core/quantity.hpp"

namespace tactus {

template <Quantity Q>
struct Out {
  ValueOf<Q> value = QuantityValue<Q>::neutral();
};

/// Value that an optional input reads when it is not wired.
template <Quantity Q>
inline const ValueOf<Q> kNeutral = QuantityValue<Q>::neutral();

template <Quantity Q>
struct In {
  const ValueOf<Q>* source = &kNeutral<Q>;

  const ValueOf<Q>& operator*() const { return *source; }
  const ValueOf<Q>* operator->() const { return source; }
  /// True if the pipeline file names a source for this input. [any]
  bool wired() const { return source != &kNeutral<Q>; }
};

}  // namespace tactus
