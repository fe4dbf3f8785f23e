#include "gateway/trajectory_columns.hpp"

#include <bitset>

#include "gateway/csv_cells.hpp"

namespace tactus {
template <class Space>
bool Columns<Space>::add(std::string_view header, Message& reason) {
  Column column;
  column.name = Name(header);
  const Name si = in_si(header, column.scale);
  if (std::string_view(si) != "time_s" && !Table::find(si, column.place)) {
    reason << not_a_column(header) << "; expected one of time_s, ";
    Table::name_them(reason);
    reason << "; or with deg, mm, ms";
    return false;
  }
  for (int i = 0; i < count_; ++i) {
    const ColumnPlace& earlier = columns_[static_cast<std::size_t>(i)].place;
    if (earlier.group == column.place.group && earlier.index == column.place.index) {
      reason << "already given in column " << i + 1;
      return false;
    }
  }
  columns_[static_cast<std::size_t>(count_++)] = column;  // no repetitions, hence never full
  return true;
}

template <class Space>
std::uint32_t Columns<Space>::given(std::size_t group) const {
  std::uint32_t bits = 0;
  for (int i = 0; i < count_; ++i) {
    const ColumnPlace& place = columns_[static_cast<std::size_t>(i)].place;
    if (place.group == static_cast<int>(group)) bits |= 1U << place.index;
  }
  return bits;
}

template <class Space>
bool Columns<Space>::complete(Message& reason) const {
  const std::uint32_t positions = given(kPositions);
  for (std::size_t i = 0; i < Table::kGroups.size(); ++i) {
    const ColumnGroup& group = Table::kGroups[i];
    const std::uint32_t found = given(i);
    const bool some = partial_ && Table::kPartial && i >= kPositions && positions != 0;
    if (found == (some ? positions : whole(i)) || (found == 0 && !group.required)) continue;
    const std::size_t count = std::bitset<32>(found).count();
    reason << group.meaning << ": " << static_cast<int>(count)
           << (count == 1 ? " column" : " columns") << ", expected ";
    if (some)
      reason << "one for each given position";
    else
      reason << group.width;
    return false;
  }
  if ((fields() & kAccelerationField) && !(fields() & kVelocityField)) {
    reason << "acceleration is given without velocity";
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
