// The bench of the tests of trajectory files of the joints: a store, and files made from text.
#pragma once

#include <unistd.h>

#include <array>
#include <cstdio>
#include <string_view>

#include "gateway/trajectory/trajectory_reader.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr int kCapacity = 20'001;

inline std::array<Waypoint<JointSpace>, kCapacity> storage;
inline Trajectory<JointSpace> g_trajectory;
inline CsvError g_error;

inline bool read(const char* path, int capacity = kCapacity) {
  g_trajectory = {};
  g_trajectory.waypoints = storage.data();
  g_trajectory.capacity = capacity;
  return read_trajectory(path, false, g_trajectory, g_error);
}

/// A file of this process; each test that uses it writes it again.
inline const char* csv_file() {
  static char path[64];
  std::snprintf(path, sizeof path, "/tmp/tactus-csv-%d.csv", static_cast<int>(getpid()));
  return path;
}

inline bool read_text(std::string_view text, int capacity = kCapacity) {
  std::FILE* file = std::fopen(csv_file(), "wb");
  assert_non_null(file);
  std::fwrite(text.data(), 1, text.size(), file);
  std::fclose(file);
  return read(csv_file(), capacity);
}

inline int remove_csv_file(void**) {
  std::remove(csv_file());
  return 0;
}

}  // namespace tactus
