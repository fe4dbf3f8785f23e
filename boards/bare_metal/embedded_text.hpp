// The text of the pipeline that the board has when it is switched on.
#pragma once

#include <string_view>

namespace bare {

std::string_view embedded_text();

}  // namespace bare
