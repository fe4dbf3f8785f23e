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
///   leave_out(bits, terms) notes what the positions do not give, where kPartial allows that
template <class Space>
struct ColumnTable;

template <>
struct ColumnTable<JointSpace> {
  static constexpr bool kPartial = true;  // some of the joints may be left out
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
  static void leave_out(std::uint32_t joints, JointSpace::Terms& terms) { terms.held = joints; }
};

template <>
struct ColumnTable<TaskSpace> {
  static constexpr bool kPartial = false;
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
  static void leave_out(std::uint32_t, TaskSpace::Terms&) {}
};

template <class Space>
class Columns {
 public:
  /// `partial`: positions of some joints only will do, where the space knows that.
  explicit Columns(bool partial) : partial_(partial) {}

  /// Takes the next header cell; false with the reason if it is unknown or a repetition.
  bool add(std::string_view header, Message& reason);
  /// After the last: time and positions are there, every other group whole or absent; else false
  /// with the reason. Whole is what the positions give, if they may be partial.
  bool complete(Message& reason) const;

  int count() const { return count_; }
  std::string_view name(int column) const {
    return columns_[static_cast<std::size_t>(column)].name;
  }
  /// Where the number of a column belongs.
  double& value(int column, Waypoint<Space>& waypoint) const;
  /// The fields that are given.
  Fields fields() const;
  /// What the positions leave out, after complete() has let it pass.
  void note_left_out(typename Space::Terms& terms) const {
    Table::leave_out(whole(kPositions) & ~given(kPositions), terms);
  }

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
  static constexpr std::size_t kPositions = 1;  // the group of the positions
  static constexpr std::uint32_t whole(std::size_t group) {
    return (1U << Table::kGroups[group].width) - 1U;
  }
  /// Bit i: number i of the group is given.
  std::uint32_t given(std::size_t group) const;

  std::array<Column, max_columns()> columns_;
  int count_ = 0;
  bool partial_;
};

}  // namespace tactus
