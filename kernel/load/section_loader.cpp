#include "kernel/load/section_loader.hpp"

#include <cassert>

namespace tactus {

bool SectionLoader::begins(const char* name) {
  names_ << (names_.empty() ? "" : ", ") << name;
  if (section_.name != name) return false;
  assert(!found_ && "two sections have the same name");
  found_ = true;
  return true;
}

}  // namespace tactus
