#include "gateway/trajectory/trajectory_columns.hpp"

#include <bitset>

#include "gateway/trajectory/csv_cells.hpp"

namespace tactus {
namespace {

struct GroupWords {
  std::string_view prefix, suffix, prismatic;  // the last in place of the suffix
};

// In the order of the groups, from the positions on; the joint is between prefix and suffix.
using JointWords = std::array<GroupWords, 4>;
constexpr JointWords kGroupWords = {{
    {"q", "_rad", "_m"},
    {"dq", "_rad_s", "_m_s"},
    {"ddq", "_rad_s2", "_m_s2"},
    {"tau", "_Nm", "_N"},
}};
// The outputs of a reference generator, as a log names them.
constexpr JointWords kLoggedWords = {
    {{"q_d_", "", ""}, {"dq_d_", "", ""}, {"ddq_d_", "", ""}, {"tau_d_", "", ""}}};
constexpr std::array<std::string_view, 6> kLoggedOutputs = {"",     "x_d_", "x_d_",
                                                            "v_d_", "a_d_", "h_d_"};

bool starts_with(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}
bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// Returns the joint given by its number from 1, or by an underscore and its name; -1 if unknown.
int joint_of(std::string_view word) {
  for (int i = 0; i < kDof; ++i) {
    Name number, named("_");
    number << i + 1;
    named << Robot::kJointNames[static_cast<std::size_t>(i)];
    if (word == std::string_view(number) || word == std::string_view(named)) return i;
  }
  return -1;
}

/// Returns "output_component" of a cell of a log, "block.output_component"; empty if it is none.
std::string_view logged_output(std::string_view header) {
  const std::size_t dot = header.find('.');
  const bool logged = dot < header.size() && header.find('_', dot) < header.size();
  return logged ? header.substr(dot + 1) : std::string_view();
}

/// Returns the joint that a header names between prefix and suffix; -1 if it names none.
int joint_between(std::string_view header, std::string_view prefix, std::string_view suffix) {
  if (!starts_with(header, prefix) || !ends_with(header, suffix)) return -1;
  if (header.size() < prefix.size() + suffix.size()) return -1;
  return joint_of(header.substr(prefix.size(), header.size() - prefix.size() - suffix.size()));
}

/// Finds the group and the joint that a header names in these words, with the unit of the joint.
bool find_joint(const JointWords& all, std::string_view header, ColumnPlace& place) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const GroupWords& words = all[i];
    for (const std::string_view suffix : {words.suffix, words.prismatic}) {
      const int joint = joint_between(header, words.prefix, suffix);
      if (joint < 0 || suffix != (is_prismatic<Robot>(joint) ? words.prismatic : words.suffix))
        continue;
      place = {static_cast<int>(i) + 1, joint};
      return true;
    }
  }
  return false;
}

struct TaskColumn {
  std::string_view header;
  ColumnPlace place;
};

// clang-format off
constexpr std::array<TaskColumn, 25> kColumns = {{
    {"x_m", {1, 0}}, {"y_m", {1, 1}}, {"z_m", {1, 2}},
    {"qw", {2, 0}}, {"qx", {2, 1}}, {"qy", {2, 2}}, {"qz", {2, 3}},
    {"vx_m_s", {3, 0}}, {"vy_m_s", {3, 1}}, {"vz_m_s", {3, 2}},
    {"wx_rad_s", {3, 3}}, {"wy_rad_s", {3, 4}}, {"wz_rad_s", {3, 5}},
    {"ax_m_s2", {4, 0}}, {"ay_m_s2", {4, 1}}, {"az_m_s2", {4, 2}},
    {"alphax_rad_s2", {4, 3}}, {"alphay_rad_s2", {4, 4}}, {"alphaz_rad_s2", {4, 5}},
    {"fx_N", {5, 0}}, {"fy_N", {5, 1}}, {"fz_N", {5, 2}},
    {"mx_Nm", {5, 3}}, {"my_Nm", {5, 4}}, {"mz_Nm", {5, 5}},
}};
// clang-format on

}  // namespace

template <class Space>
bool Columns<Space>::add(std::string_view header, Message& reason) {
  Column column;
  column.name = Name(header);
  column.cell = ++cells_;
  if (const std::string_view output = logged_output(header); !output.empty()) {
    logged_ = true;
    if (!Table::find_logged(output, column.place)) return true;
  } else if (const Name si = in_si(header, column.scale);
             std::string_view(si) != "time_s" && !Table::find(si, column.place)) {
    reason << not_a_column(header) << "; expected one of time_s, ";
    Table::name_them(reason);
    reason << "; or with deg, mm, ms";
    return false;
  }
  for (int i = 0; i < count_; ++i) {
    const Column& earlier = columns_[static_cast<std::size_t>(i)];
    if (earlier.place.group == column.place.group && earlier.place.index == column.place.index) {
      reason << "already given in column " << earlier.cell;
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
    if (logged_ && count == 0)
      reason << "; the log has no reference: name it in [recorder] signals, jrg.q_d for example";
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

bool ColumnTable<JointSpace>::find(std::string_view header, ColumnPlace& place) {
  return find_joint(kGroupWords, header, place);
}

bool ColumnTable<JointSpace>::find_logged(std::string_view output, ColumnPlace& place) {
  return find_joint(kLoggedWords, output, place);
}

double& ColumnTable<JointSpace>::value(const ColumnPlace& place, JointSpace::Point& point) {
  JointVector* const groups[] = {&point.q, &point.dq, &point.ddq, &point.tau};
  return (*groups[place.group - 1])[place.index];
}

void ColumnTable<JointSpace>::name_them(Message& message) {
  if constexpr (has_prismatic<Robot>()) {
    for (int i = 0; i < kDof; ++i) message << "q" << i + 1 << "_" << position_unit(i) << ", ";
    message << "dq1_" << position_unit(0) << "_s, ddq1_" << position_unit(0) << "_s2, tau1_"
            << (is_prismatic<Robot>(0) ? "N" : "Nm") << " and so on";
  } else {
    message << "q1_rad, dq1_rad_s, ddq1_rad_s2, tau1_Nm, up to joint " << kDof;
  }
}

bool ColumnTable<TaskSpace>::find(std::string_view header, ColumnPlace& place) {
  for (const TaskColumn& column : kColumns) {
    if (column.header != header) continue;
    place = column.place;
    return true;
  }
  return false;
}

bool ColumnTable<TaskSpace>::find_logged(std::string_view output, ColumnPlace& place) {
  for (const TaskColumn& column : kColumns) {
    Name logged(kLoggedOutputs[static_cast<std::size_t>(column.place.group)]);
    logged << column.header.substr(0, column.header.find('_'));
    if (output != std::string_view(logged)) continue;
    place = column.place;
    return true;
  }
  return false;
}

double& ColumnTable<TaskSpace>::value(const ColumnPlace& place, TaskSpace::Point& point) {
  const int i = place.index;
  Eigen::Quaterniond& r = point.x.r;
  double* const orientation[] = {&r.w(), &r.x(), &r.y(), &r.z()};
  Vector6* const groups[] = {&point.v, &point.a, &point.h};
  return place.group == 1   ? point.x.p[i]
         : place.group == 2 ? *orientation[i]
                            : (*groups[place.group - 3])[i];
}

void ColumnTable<TaskSpace>::name_them(Message& message) {
  message << "x_m y_m z_m, qw qx qy qz, vx_m_s .. wz_rad_s, ax_m_s2 .. alphaz_rad_s2, "
             "fx_N .. mz_Nm";
}

}  // namespace tactus
