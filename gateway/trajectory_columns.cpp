#include "gateway/trajectory_columns.hpp"

namespace tactus {

template <class Space>
bool Columns<Space>::add(std::string_view header, Message& reason) {
  Column column;
  column.name = Name(header);
  if (header != "time_s" && !Table::find(header, column.place)) {
    reason << "unknown column; expected time_s and ";
    Table::name_them(reason);
    return false;
  }
  for (int i = 0; i < count_; ++i) {
    const ColumnPlace& earlier = columns_[static_cast<std::size_t>(i)].place;
    if (earlier.group == column.place.group && earlier.index == column.place.index) {
      reason << "the column stands already at " << i + 1;
      return false;
    }
  }
  columns_[static_cast<std::size_t>(count_++)] = column;  // no repetitions, hence never full
  return true;
}

template <class Space>
int Columns<Space>::given(std::size_t group) const {
  int count = 0;
  for (int i = 0; i < count_; ++i) {
    count += columns_[static_cast<std::size_t>(i)].place.group == static_cast<int>(group);
  }
  return count;
}

template <class Space>
bool Columns<Space>::complete(Message& reason) const {
  for (std::size_t i = 0; i < Table::kGroups.size(); ++i) {
    const ColumnGroup& group = Table::kGroups[i];
    const int found = given(i);
    if (found == group.width || (found == 0 && !group.required)) continue;
    reason << group.meaning << ": " << found << (found == 1 ? " column" : " columns")
           << ", expected " << group.width;
    return false;
  }
  if ((fields() & kAccelerationField) && !(fields() & kVelocityField)) {
    reason << "acceleration without velocity";
    return false;
  }
  return true;
}

template <class Space>
double& Columns<Space>::value(int column, Waypoint<Space>& waypoint) const {
  const ColumnPlace& place = columns_[static_cast<std::size_t>(column)].place;
  return place.group == 0 ? waypoint.time_s : Table::value(place, waypoint.point);
}

template <class Space>
Fields Columns<Space>::fields() const {
  Fields fields = 0;
  for (std::size_t i = 0; i < Table::kGroups.size(); ++i) {
    if (given(i) > 0) fields = static_cast<Fields>(fields | Table::kGroups[i].field);
  }
  return fields;
}

template class Columns<JointSpace>;
template class Columns<TaskSpace>;

}  // namespace tactus
