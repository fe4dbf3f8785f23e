// The bench of the tests of trajectory files of the joints: a store, and files made from text.
#pragma once

#include <unistd.h>

#include <array>
#include <cstdio>
#include <string_view>

#include "gateway/trajectory_csv.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr int kCapacity = 20'001;

inline std::array<Waypoint<JointSpace>, kCapacity> storage;
inline Trajectory<JointSpace> trajectory;
inline CsvError error;

inline bool read(const char* path, int capacity = kCapacity) {
  trajectory = {};
  trajectory.waypoints = storage.data();
  trajectory.capacity = capacity;
  return read_trajectory(path, false, trajectory, error);
}

/// A file of this process; each test that uses it writes it again.
inline const char* scratch() {
  static char path[64];
  std::snprintf(path, sizeof path, "/tmp/tactus-csv-%d.csv", static_cast<int>(getpid()));
  return path;
}

inline bool read_text(std::string_view text, int capacity = kCapacity) {
  std::FILE* file = std::fopen(scratch(), "wb");
  assert_non_null(file);
  std::fwrite(text.data(), 1, text.size(), file);
  std::fclose(file);
  return read(scratch(), capacity);
}

inline int remove_scratch(void**) {
  std::remove(scratch());
  return 0;
}

}  // namespace tactus
