// Planted sources of tests/wcet/planted, built for the Cortex-M7 and given to the static analysis.
#pragma once

#include <cstdlib>

#include "tests/program/program_bench.hpp"

namespace tactus {

/// Builds a planted source for the Cortex-M7.
inline void build(const char* name, const char* flags = "-fno-ipa-icf") {
  assert_succeeds(
      "command -v arm-none-eabi-g++ && command -v glpsol || "
      "{ echo as root: scripts/setup test >&2; false; }");
  setenv("NAME", name, 1);
  setenv("M7", "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16 -O3 -g", 1);
  setenv("FLAGS", flags, 1);
  const int code = shell(
      "mkdir -p $S/$NAME && arm-none-eabi-g++ $M7 $FLAGS -std=c++17 -I. -DNDEBUG -fstack-usage "
      "-fcallgraph-info=su -c tests/wcet/planted/$NAME.cpp -o $S/$NAME/planted.o && "
      "arm-none-eabi-g++ $M7 -nostdlib -nostartfiles -Wl,--entry=planted "
      "-Wl,--unresolved-symbols=ignore-all -o $S/$NAME/planted.elf $S/$NAME/planted.o -lgcc");
  assert_int_equal(code, 0);
}

inline int bound(const char* name) {
  build(name);
  return shell("scripts/wcet_bound $S/$NAME/planted.elf --function '^planted$' --dof 7");
}

/// The bound that was printed, in instructions.
inline int instructions(const char* function = "planted") {
  Line name("\n");
  name << function << " ";
  const std::size_t at = output().find(name.c_str());
  assert_true(at != std::string_view::npos);
  return std::atoi(output().data() + at + std::strlen(name.c_str()));
}

}  // namespace tactus
