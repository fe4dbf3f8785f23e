// Columns: what each column of a trajectory file holds, by its header.
#pragma once

#include <array>
#include <string_view>

#include "kernel/load_error.hpp"
#include "kernel/reference/trajectory.hpp"

namespace tactus {

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
  double& value(int column, Waypoint<JointSpace>& waypoint) const;
  /// The fields that are given.
  Fields fields() const;

 private:
  enum Group : int { kTime, kPosition, kVelocity, kAcceleration, kEffort, kGroups };
  static constexpr int kMaxColumns = 1 + 4 * kDof;
  struct Column {
    Name name;
    Group group = kTime;
    int joint = 0;
  };

  static bool parse(std::string_view header, Column& column);
  int given(Group group) const;

  std::array<Column, kMaxColumns> columns_;
  int count_ = 0;
};

}  // namespace tactus
