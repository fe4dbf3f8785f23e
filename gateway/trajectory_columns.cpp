#include "gateway/trajectory_columns.hpp"

#include <bitset>

namespace tactus {
namespace {

/// A unit that files may use in place of one of SI.
struct Unit {
  std::string_view name, si;
  double scale;  // SI units in one of it
};

constexpr double kPi = 3.14159265358979323846;
constexpr std::array<Unit, 3> kUnits = {
    {{"_deg", "_rad", kPi / 180.0}, {"_mm", "_m", 1e-3}, {"_ms", "_s", 1e-3}}};

/// Returns the header with the SI unit in place of another, which is a whole word of it.
Name in_si(std::string_view header, double& scale) {
  scale = 1.0;
  for (const Unit& unit : kUnits) {
    const std::size_t at = header.find(unit.name);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = header.substr(at + unit.name.size());
    if (!rest.empty() && rest.front() != '_') continue;
    scale = unit.scale;
    Name changed(header.substr(0, at));
    changed << unit.si << rest;
    return changed;
  }
  return Name(header);
}

}  // namespace

template <class Space>
bool Columns<Space>::add(std::string_view header, Message& reason) {
  Column column;
  column.name = Name(header);
  const Name si = in_si(header, column.scale);
  if (std::string_view(si) != "time_s" && !Table::find(si, column.place)) {
    reason << "unknown column; expected one of time_s, ";
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
