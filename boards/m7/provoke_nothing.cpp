#include "boards/m7/provoke.hpp"

namespace m7 {

tactus::Status provoke(tactus::ByteReader) {
  return tactus::Status::kNotOffered;
}

void provoked_cycle() {}

}  // namespace m7
