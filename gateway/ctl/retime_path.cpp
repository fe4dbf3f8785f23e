// retime: reads a path of joints or of the tip, writes the fastest trajectory along it.
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "gateway/ctl/retime/retime_limits.hpp"
#include "gateway/ctl/retime/retimer.hpp"
#include "gateway/ctl/row_reader.hpp"
#include "gateway/ctl/verbs.hpp"
#include "kernel/robots/robot_table.hpp"

namespace tactus::ctl {
namespace {

constexpr double kUnitTolerance = 1e-3;  // of a quaternion's length, as admission has it

/// A path, and what is known when it is read.
struct PathFile {
  const Options& options;
  const RobotLimits& limits;
  RowReader reader;
  bool tip = false;
  std::vector<Numbers> path;
  std::string error;

  bool refuse(const std::string& text) {
    error = options.file + text;
    return false;
  }
  bool refuse_row(const std::string& text) {
    return refuse(":" + std::to_string(reader.line()) + ": " + text);
  }
};

bool judge_options(PathFile& file) {
  if (!file.tip && file.options.tolerance_m > 0.0)
    return file.refuse(": a path of joints has no --tolerance-m; give --tolerance in rad");
  if (file.tip && file.options.radius_rad > 0.0)
    return file.refuse(": a path of the tip has no --radius; give --tolerance-m and --tolerance");
  if (file.tip && file.limits.tip.v.size() == 0)
    return file.refuse(
        ": a path of the tip, and the pipeline that is served takes none; give --robot");
  return true;
}

/// Also moves positions at an end of the range inside by up to kRoom: between the waypoints of a
/// rounded path its polynomials are beyond its positions by less than that.
bool judge_joints(PathFile& file, Numbers& q) {
  constexpr double kRoom = 1e-6;  // rad or m
  const RobotLimits& limits = file.limits;
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const JointName& joint = limits.joints[static_cast<std::size_t>(k)];
    if (!(q[k] >= limits.lowest[k] && q[k] <= limits.highest[k]))
      return file.refuse_row(joint.name + formatted(": %.6g is not", q[k]) +
                             formatted(" from %.6g", limits.lowest[k]) +
                             formatted(" to %.6g ", limits.highest[k]) + joint.unit() +
                             "; plan inside of the range");
  }
  q = q.max(limits.lowest + kRoom).min(limits.highest - kRoom);
  return true;
}

/// Also makes the quaternion unit, of its two signs the one nearer to that of the last waypoint.
bool judge_pose(PathFile& file, Numbers& x) {
  const double farthest = x.head<3>().abs().maxCoeff(), length = x.tail<4>().matrix().norm();
  if (!(farthest <= kWorkspace_m))
    return file.refuse_row(formatted("the tip is %.6g m from the base along an axis,", farthest) +
                           formatted(" more than %.6g m; plan inside of the box", kWorkspace_m));
  if (!(std::abs(length - 1.0) <= kUnitTolerance))
    return file.refuse_row(formatted("the quaternion has the length %.6g; normalise it", length));
  const bool turned = !file.path.empty() && (x * file.path.back()).tail<4>().sum() < 0.0;
  x.tail<4>() /= turned ? -length : length;
  return true;
}

/// Appends the waypoints of the file to the path.
bool read_path(PathFile& file) {
  RowReader& reader = file.reader;
  const auto unreadable = [&file] {
    file.error = file.reader.error();
    return false;
  };
  if (!reader.open(file.options.file, file.limits.joints, {true, false})) return unreadable();
  file.tip = reader.form().poses;
  if (!judge_options(file)) return false;
  Row row;
  RowResult taken = RowResult::kRow;
  while ((taken = reader.next(row)) == RowResult::kRow) {
    Numbers q = Eigen::Map<const Numbers>(row.numbers.data(), reader.form().position());
    if (!(file.tip ? judge_pose(file, q) : judge_joints(file, q))) return false;
    file.path.push_back(std::move(q));
  }
  return taken == RowResult::kEnd || unreadable();
}

RetimeSettings settings_for(const PathFile& file) {
  const Options& options = file.options;
  const MotionBounds& most = file.tip ? file.limits.tip : file.limits.joint;
  RetimeSettings settings;
  settings.tip = file.tip;
  settings.bounds = {most.v * options.velocity_scale, most.a * options.acceleration_scale,
                     most.j * options.acceleration_scale};
  settings.corners.radius = options.radius_rad;
  settings.jerk = options.jerk;
  Numbers& tolerance = settings.corners.tolerance;
  if (options.tolerance_rad > 0.0 || options.tolerance_m > 0.0)
    tolerance.setConstant(most.v.size(), options.tolerance_rad);
  if (file.tip && tolerance.size() > 0) tolerance[0] = options.tolerance_m;
  return settings;
}

void write_group(std::FILE* out, const Numbers& values) {
  for (const double value : values) std::fprintf(out, ",%.17g", value);
}

void write_header(std::FILE* out, const PathFile& file) {
  const bool jerk = file.options.jerk;
  std::fprintf(out, "# %s retimed for %s by tactusctl\ntime_s", file.options.file.c_str(),
               file.limits.robot.c_str());
  if (file.tip) {
    std::fputs(",x_m,y_m,z_m,qw,qx,qy,qz,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s", out);
    if (jerk) std::fputs(",ax_m_s2,ay_m_s2,az_m_s2,alphax_rad_s2,alphay_rad_s2,alphaz_rad_s2", out);
  } else {
    const auto group = [&](const char* prefix, const char* suffix) {
      int number = 0;
      for (const JointName& joint : file.limits.joints)
        std::fprintf(out, ",%s%d_%s%s", prefix, ++number, joint.unit(), suffix);
    };
    group("q", "");
    group("dq", "_s");
    if (jerk) group("ddq", "_s2");
  }
  std::fputc('\n', out);
}

bool write_trajectory(const PathFile& file, const std::vector<TimedPoint>& points) {
  const Options& options = file.options;
  std::FILE* out = options.out == "-" ? stdout : std::fopen(options.out.c_str(), "wb");
  if (out == nullptr) return false;
  write_header(out, file);
  for (const TimedPoint& point : points) {
    std::fprintf(out, "%.17g", point.time_s);
    write_group(out, point.q);
    write_group(out, point.dq);
    if (options.jerk) write_group(out, point.ddq);
    std::fputc('\n', out);
  }
  const bool good = std::ferror(out) == 0;
  return (out == stdout ? std::fflush(out) : std::fclose(out)) == 0 && good;
}

}  // namespace

int retime_path(const Options& options, Output& output) {
  RobotLimits limits;
  const int found = find_limits(options, output, limits);
  if (found != kSucceeded) return found;
  PathFile file = {options, limits, {}, false, {}, {}};
  std::vector<TimedPoint> points;
  if (read_path(file)) {
    points = retime(file.path, settings_for(file));
    if (points.empty()) file.refuse(": no way to go; give at least two different waypoints");
  }
  if (file.error.empty() && !write_trajectory(file, points))
    file.error = options.out + ": " + std::strerror(errno) + "; give a file that can be written";
  if (!file.error.empty()) {
    output.error(file.error, kRefused);
    return kRefused;
  }
  std::fprintf(stderr, "%s: %zu waypoints, %.4f s for %s\n", options.out.c_str(), points.size(),
               points.back().time_s, limits.robot.c_str());
  return kSucceeded;
}

}  // namespace tactus::ctl
