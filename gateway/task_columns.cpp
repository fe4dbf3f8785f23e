// The columns of the tool tip, each with a name of its own.
#include "gateway/trajectory_columns.hpp"

namespace tactus {
namespace {

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

bool ColumnTable<TaskSpace>::find(std::string_view header, ColumnPlace& place) {
  for (const TaskColumn& column : kColumns) {
    if (column.header != header) continue;
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
