// Columns: what each column of a trajectory file holds, by its header. The words are a table per
// space; whatever goes by them is written once.
#pragma once

#include <array>
#include <string_view>

#include "kernel/load_error.hpp"
#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"
#include "kernel/reference/trajectory.hpp"

namespace tactus {

/// Columns that are given together or left out together.
struct ColumnGroup {
  std::string_view meaning;
  int width;             ///< columns
  bool required = true;  ///< may not be left out
  Fields field = 0;      ///< of a trajectory, given with them
};

/// Where the number of a column belongs.
struct ColumnPlace {
  int group = 0, index = 0;
};

/// The columns of one space: kGroups, the first of which is the time, and
///   find(header, place)    the place of a column; false if the space has none of that name
///   value(place, point)    the number at a place that is not the time
///   name_them(message)     appends what headers may be
template <class Space>
struct ColumnTable;

template <>
struct ColumnTable<JointSpace> {
  static constexpr std::array<ColumnGroup, 5> kGroups = {{
      {"time", 1},
      {"position", kDof},
      {"velocity", kDof, false, kVelocityField},
      {"acceleration", kDof, false, kAccelerationField},
      {"effort", kDof, false, kEffortField},
  }};
  static bool find(std::string_view header, ColumnPlace& place);
  static double& value(const ColumnPlace& place, JointSpace::Point& point);
  static void name_them(Message& message);
};

template <>
struct ColumnTable<TaskSpace> {
  static constexpr std::array<ColumnGroup, 6> kGroups = {{
      {"time", 1},
      {"position", 3},
      {"orientation", 4},
      {"velocity", 6, false, kVelocityField},
      {"acceleration", 6, false, kAccelerationField},
      {"wrench", 6, false, kEffortField},
  }};
  static bool find(std::string_view header, ColumnPlace& place);
  static double& value(const ColumnPlace& place, TaskSpace::Point& point);
  static void name_them(Message& message);
};

template <class Space>
class Columns {
 public:
  /// Takes the next header cell; false with the reason if it is unknown or a repetition.
  bool add(std::string_view header, Message& reason);
  /// After the last: time and positions are there, every other group whole or absent; else false
  /// with the reason.
  bool complete(Message& reason) const;

  int count() const { return count_; }
  std::string_view name(int column) const {
    return columns_[static_cast<std::size_t>(column)].name;
  }
  /// Where the number of a column belongs.
  double& value(int column, Waypoint<Space>& waypoint) const;
  /// The fields that are given.
  Fields fields() const;

 private:
  using Table = ColumnTable<Space>;
  struct Column {
    Name name;
    ColumnPlace place;
  };

  static constexpr std::size_t max_columns() {
    std::size_t count = 0;
    for (const ColumnGroup& group : Table::kGroups) count += static_cast<std::size_t>(group.width);
    return count;
  }
  int given(std::size_t group) const;

  std::array<Column, max_columns()> columns_;
  int count_ = 0;
};

}  // namespace tactus
