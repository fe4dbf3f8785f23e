// Numbers in a pipeline file: decimal text to value without a C library, the same bits on every
// machine.
#pragma once

#include <string_view>

namespace tactus {

/// Decimal text to double, correctly rounded up to 18 digits and within 1 ulp beyond; what is too
/// small for a double is zero. False, and `value` untouched, unless the whole text is a finite
/// number: "nan", "inf", "1e999" and "0x10" are none. [init]
bool parse_number(std::string_view text, double& value);

/// Decimal text to int; false, and `value` untouched, unless the whole text is one that fits.
/// [init]
bool parse_number(std::string_view text, int& value);

}  // namespace tactus
