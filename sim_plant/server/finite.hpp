// A validator that the command lines of all emulators share. For the options.cpp of a program only:
// CLI11 needs exceptions.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <string>

namespace tactus {

/// Accepts finite numbers in range; the library also accepts "nan" and "inf".
inline CLI::Validator finite(double lowest, double highest) {
  return CLI::Validator(
      [lowest, highest](std::string& text) {
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        const bool good = *end == '\0' && !text.empty() && value >= lowest && value <= highest;
        return good ? std::string()
                    : "'" + text + "' is not a number from " + std::to_string(lowest) + " to " +
                          std::to_string(highest);
      },
      "");
}

}  // namespace tactus
