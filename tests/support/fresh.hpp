// A bench that is too large for the stack, and whose destructor a failed assertion would leave out.
#pragma once

#include <utility>

namespace tactus {

/// A started bench of a kind; there is one at a time, and the next one deletes it.
template <class Bench, class... Arguments>
Bench& fresh(Arguments&&... arguments) {
  static Bench* bench = nullptr;
  delete bench;
  bench = new Bench;
  bench->start(std::forward<Arguments>(arguments)...);
  return *bench;
}

}  // namespace tactus
