// Columns: the meaning of the columns of a trajectory file, by their headers. Each space has its
// own table of headers (ColumnTable).
#pragma once

#include <array>
#include <string_view>

#include "kernel/core/load_error.hpp"
#include "kernel/reference/motion/trajectory.hpp"
#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

/// Columns that are all given or all left out.
struct ColumnGroup {
  std::string_view meaning;
  int width;             ///< columns
  bool required = true;  ///< may not be left out
  Fields field = 0;      ///< the field of a trajectory that they give
};

/// The place of a column: its group, and its index in the group.
struct ColumnPlace {
  int group = 0, index = 0;
};

/// The columns of one space: kGroups, of which the first is the time, and
///   find(header, place)     finds the place of a column; false if the space has none of that name
///   find_logged(output, place) does so for a column of a log, by its output: q_d_1 of jrg.q_d_1
///   value(place, point)     returns the number at a place that is not the time
///   name_them(message)      appends the allowed headers
///   leave_out(bits, header) writes the joints that are not given into the header, if kPartial
///   in_base(header)         has the header name no frames
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
  static bool find_logged(std::string_view output, ColumnPlace& place);
  static double& value(const ColumnPlace& place, JointSpace::Point& point);
  static void name_them(Message& message);
  static void leave_out(std::uint32_t joints, JointSpace::Header& header) { header.held = joints; }
  static void in_base(JointSpace::Header&) {}
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
  static bool find_logged(std::string_view output, ColumnPlace& place);
  static double& value(const ColumnPlace& place, TaskSpace::Point& point);
  static void name_them(Message& message);
  static void leave_out(std::uint32_t, TaskSpace::Header&) {}
  static void in_base(TaskSpace::Header& header) { header = {}; }
};

template <class Space>
class Columns {
 public:
  static constexpr std::size_t kMost = [] {
    std::size_t count = 0;
    for (const ColumnGroup& group : ColumnTable<Space>::kGroups)
      count += static_cast<std::size_t>(group.width);
    return count;
  }();

  /// `partial`: positions of some of the joints are enough, if the space allows it.
  explicit Columns(bool partial) : partial_(partial) {}

  /// Adds the next header cell; false with the reason if it is unknown or repeated. Degrees,
  /// millimetres and milliseconds are units too: q1_deg, vx_mm_s, time_ms. Of the log of a run,
  /// whose cells are called block.output_component, the columns of the reference are added and the
  /// others are skipped.
  bool add(std::string_view header, Message& reason);
  /// Checks the header after its last cell: time and positions are given, every other group is
  /// whole or absent; else false with the reason. With partial positions, a whole group has the
  /// same joints as the positions.
  bool complete(Message& reason) const;

  int count() const { return count_; }
  /// Cells of the header, those that are skipped too.
  int cells() const { return cells_; }
  /// Returns true if a column is that of a cell, which counts from 1.
  bool is_at(int column, int cell) const {
    return column < count_ && columns_[static_cast<std::size_t>(column)].cell == cell;
  }
  std::string_view name(int column) const {
    return columns_[static_cast<std::size_t>(column)].name;
  }
  /// Returns the number of a waypoint that a column gives, in SI units.
  double& value(int column, Waypoint<Space>& waypoint) const;
  /// Returns the SI units in one unit of a column.
  double scale(int column) const { return columns_[static_cast<std::size_t>(column)].scale; }
  /// Returns the fields that are given.
  Fields fields() const;
  /// Writes the joints that the positions leave out into the header, and that a log, whose poses
  /// are those of the base, has no frames; call after complete().
  void note_terms(typename Space::Header& header) const {
    Table::leave_out(whole(kPositions) & ~given(kPositions), header);
    if (logged_) Table::in_base(header);
  }

 private:
  using Table = ColumnTable<Space>;
  struct Column {
    Name name;
    ColumnPlace place;
    double scale = 1.0;
    int cell = 0;
  };

  static constexpr std::size_t kPositions = 1;  // the group of the positions
  static constexpr std::uint32_t whole(std::size_t group) {
    return (1U << Table::kGroups[group].width) - 1U;
  }
  /// Returns a bit for each number of the group that is given: bit i for number i.
  std::uint32_t given(std::size_t group) const;

  std::array<Column, kMost> columns_;
  int count_ = 0, cells_ = 0;
  bool partial_, logged_ = false;
};

}  // namespace tactus
