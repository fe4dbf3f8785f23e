#include "gateway/trajectory_columns.hpp"

namespace tactus {
namespace {

struct GroupWords {
  std::string_view prefix, suffix, meaning;
};

// In the order of Columns::Group; the joint stands between prefix and suffix.
constexpr std::array<GroupWords, 5> kGroupWords = {{
    {"time", "_s", "time"},
    {"q", "_rad", "position"},
    {"dq", "_rad_s", "velocity"},
    {"ddq", "_rad_s2", "acceleration"},
    {"tau", "_Nm", "effort"},
}};

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}
bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// Joint by number from 1, or by its name after an underscore; -1 if it is none.
int joint_of(std::string_view word) {
  for (int i = 0; i < kDof; ++i) {
    Name number, named("_");
    number << i + 1;
    named << Robot::kJointNames[static_cast<std::size_t>(i)];
    if (word == std::string_view(number) || word == std::string_view(named)) return i;
  }
  return -1;
}

}  // namespace

bool Columns::parse(std::string_view header, Column& column) {
  column.name = Name(header);
  if (header == "time_s") return true;
  for (int group = kPosition; group < kGroups; ++group) {
    const GroupWords& words = kGroupWords[static_cast<std::size_t>(group)];
    if (!starts_with(header, words.prefix) || !ends_with(header, words.suffix)) continue;
    std::string_view word = header;
    word.remove_prefix(words.prefix.size());
    if (word.size() < words.suffix.size()) continue;
    word.remove_suffix(words.suffix.size());
    column.joint = joint_of(word);
    column.group = static_cast<Group>(group);
    if (column.joint >= 0) return true;
  }
  return false;
}

bool Columns::add(std::string_view header, Message& reason) {
  Column column;
  if (!parse(header, column)) {
    reason
        << "unknown column; expected time_s and q1_rad, dq1_rad_s, ddq1_rad_s2, tau1_Nm to joint "
        << kDof;
    return false;
  }
  for (int i = 0; i < count_; ++i) {
    const Column& earlier = columns_[static_cast<std::size_t>(i)];
    if (earlier.group == column.group && earlier.joint == column.joint) {
      reason << "the column stands already at " << i + 1;
      return false;
    }
  }
  columns_[static_cast<std::size_t>(count_++)] = column;  // no repetitions, hence never full
  return true;
}

int Columns::given(Group group) const {
  int count = 0;
  for (int i = 0; i < count_; ++i) count += columns_[static_cast<std::size_t>(i)].group == group;
  return count;
}

bool Columns::complete(Message& reason) const {
  for (int group = kTime; group < kGroups; ++group) {
    const int found = given(static_cast<Group>(group));
    const int whole = group == kTime ? 1 : kDof;
    const bool required = group <= kPosition;
    if (found == whole || (found == 0 && !required)) continue;
    reason << kGroupWords[static_cast<std::size_t>(group)].meaning << ": " << found
           << (found == 1 ? " column" : " columns") << ", expected " << whole;
    return false;
  }
  if (given(kAcceleration) > 0 && given(kVelocity) == 0) {
    reason << "acceleration without velocity";
    return false;
  }
  return true;
}

double& Columns::value(int column, Waypoint<JointSpace>& waypoint) const {
  const Column& at = columns_[static_cast<std::size_t>(column)];
  switch (at.group) {
    case kPosition:
      return waypoint.point.q[at.joint];
    case kVelocity:
      return waypoint.point.dq[at.joint];
    case kAcceleration:
      return waypoint.point.ddq[at.joint];
    case kEffort:
      return waypoint.point.tau[at.joint];
    default:
      return waypoint.time_s;
  }
}

Fields Columns::fields() const {
  return static_cast<Fields>((given(kVelocity) > 0 ? kVelocityField : 0) |
                             (given(kAcceleration) > 0 ? kAccelerationField : 0) |
                             (given(kEffort) > 0 ? kEffortField : 0));
}

}  // namespace tactus
