// The files of the page, which are part of the program: gateway/page/web.
#pragma once

#include <string_view>

namespace tactus {

struct PageFile {
  std::string_view path;  ///< of the request
  const char* type;       ///< media type
  std::string_view bytes;
};

/// Returns the file of a path, null if there is none. [any]
const PageFile* page_file(std::string_view path);

}  // namespace tactus
