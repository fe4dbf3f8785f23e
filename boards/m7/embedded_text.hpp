// The text of the pipeline that the board has when it is switched on.
#pragma once

#include <string_view>

namespace m7 {

std::string_view embedded_text();

}  // namespace m7
