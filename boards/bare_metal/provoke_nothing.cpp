#include "boards/bare_metal/provoke.hpp"

namespace bare {

tactus::Status provoke(tactus::ByteReader) {
  return tactus::Status::kNotOffered;
}

void provoked_cycle() {}

}  // namespace bare
