// Ports: how blocks are joined. An Out is the value and is owned by the block that writes it; an In
// is a pointer to it, bound once by the loader. The quantity is part of the type, so a velocity
// cannot be read as a position.
#pragma once

#include "kernel/quantity.hpp"

namespace tactus {

template <Quantity Q>
struct Out {
  ValueOf<Q> value = QuantityValue<Q>::neutral();
};

/// What an optional input reads when it is not wired.
template <Quantity Q>
inline const ValueOf<Q> kNeutral = QuantityValue<Q>::neutral();

template <Quantity Q>
struct In {
  const ValueOf<Q>* source = &kNeutral<Q>;

  const ValueOf<Q>& operator*() const { return *source; }
  const ValueOf<Q>* operator->() const { return source; }
  /// True when the pipeline file named a source for this input. [any]
  bool wired() const { return source != &kNeutral<Q>; }
};

}  // namespace tactus
