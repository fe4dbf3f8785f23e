// What an image for measurements needs of the computer that emulates it, beside
// boards/bare_metal/semihosting.hpp.
#pragma once

#include "boards/bare_metal/semihosting.hpp"

namespace semihosting {

void print(const char* text);
void print(std::uint32_t number);
/// Reads the whole file into `buffer` if it fits; returns its size, 0 if there is no such file.
std::size_t read_file(const char* path, std::uint8_t* buffer, std::size_t capacity);

}  // namespace semihosting
