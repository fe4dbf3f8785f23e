#include "program/results/json_string.hpp"

namespace tactus {
namespace {

/// Returns the length of the character of UTF-8 (RFC 3629, section 4) at the beginning of `text`, 0
/// if there is none.
std::size_t character_length(std::string_view text) {
  const auto at = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = at(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (at(i) < 0x80 || at(i) > 0xbf) return 0;
  const unsigned char second = at(1);
  const bool overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool surrogate = first == 0xed && second > 0x9f;
  const bool beyond = first == 0xf4 && second > 0x8f;
  return overlong || surrogate || beyond ? 0 : length;
}

void write_ascii(std::FILE* file, char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte < 0x20)
    std::fprintf(file, "\\u%04x", static_cast<unsigned>(byte));
  else if (c == '"' || c == '\\')
    std::fprintf(file, "\\%c", c);
  else
    std::fputc(c, file);
}

}  // namespace

void write_json_string(std::FILE* file, std::string_view text) {
  std::fputc('"', file);
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0)
      std::fputs("\\ufffd", file);
    else if (length == 1)
      write_ascii(file, text.front());
    else
      std::fwrite(text.data(), 1, length, file);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  std::fputc('"', file);
}

}  // namespace tactus
