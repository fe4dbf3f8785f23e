// What an image for measurements needs of the computer that emulates it, beside
// boards/m7/semihosting.hpp.
#pragma once

#include "boards/m7/semihosting.hpp"

namespace semihosting {

void print(const char* text);
void print(std::uint32_t number);
/// Reads the whole file into `buffer` if it fits; returns its size, 0 if there is no such file.
std::size_t read_file(const char* path, std::uint8_t* buffer, std::size_t capacity);

}  // namespace semihosting
