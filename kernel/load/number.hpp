// Numbers in a pipeline file: converts decimal text to a value without a C library, with the same
// bits on every machine.
#pragma once

#include <string_view>

namespace tactus {

/// Converts decimal text to a double, correctly rounded up to 18 digits and within 1 ulp beyond; a
/// number too small for a double becomes zero. Returns false, and leaves `value` unchanged, unless
/// the whole text is a finite number: "nan", "inf", "1e999" and "0x10" are not. [init]
bool parse_number(std::string_view text, double& value);

/// Converts decimal text to an int. Returns false, and leaves `value` unchanged, unless the whole
/// text is one that fits. [init]
bool parse_number(std::string_view text, int& value);

}  // namespace tactus
