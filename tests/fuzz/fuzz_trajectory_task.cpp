// Fuzzes trajectory files of the tool tip.
#include "tests/fuzz/number_mutator.hpp"
#include "tests/fuzz/trajectory_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using File = tactus::fuzz::TrajectoryFile<tactus::TaskSpace>;
  static File::Store store;
  static File file(store);
  file.play(data, size);
  return 0;
}
