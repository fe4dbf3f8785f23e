// Strings of JSON (RFC 8259, section 7), which are UTF-8 whatever bytes a user's file name has.
#pragma once

#include <cstdio>
#include <string_view>

namespace tactus {

/// Writes `text` in quotation marks; a byte that is no part of UTF-8 becomes U+FFFD.
void write_json_string(std::FILE* file, std::string_view text);

}  // namespace tactus
