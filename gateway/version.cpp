#include "gateway/version.hpp"

namespace tactus {

const char* const kVersion = TACTUS_VERSION;

}  // namespace tactus
