// retime: reads a path, writes the fastest trajectory along it. Limits are those of a robot's table
// or, of the pipeline that is served, of the server.
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "gateway/ctl/retime/retimer.hpp"
#include "gateway/ctl/row_reader.hpp"
#include "gateway/ctl/verbs.hpp"
#include "kernel/robots/fer.hpp"
#include "kernel/robots/gen3.hpp"
#include "kernel/robots/ur10.hpp"

namespace tactus::ctl {
namespace {

struct RobotLimits {
  std::string robot;
  std::vector<std::string> joints;
  MotionBounds bounds;
  Joints lowest, highest;

  void resize(Eigen::Index count) {
    for (Joints* one : {&bounds.v, &bounds.a, &bounds.j, &lowest, &highest}) one->resize(count);
  }
};

template <class Robot>
bool use_table(const std::string& name, RobotLimits& limits) {
  if (name != Robot::kName) return false;
  limits.robot = name;
  limits.resize(Robot::kDof);
  for (std::size_t i = 0; i < Robot::kLimits.size(); ++i) {
    const JointLimit& limit = Robot::kLimits[i];
    const auto k = static_cast<Eigen::Index>(i);
    limits.joints.emplace_back(Robot::kJointNames[i]);
    limits.lowest[k] = limit.q_min;
    limits.highest[k] = limit.q_max;
    limits.bounds.v[k] = limit.dq_max;
    limits.bounds.a[k] = limit.ddq_max;
    limits.bounds.j[k] = limit.dddq_max;
  }
  return true;
}

bool ask_server(const Options& options, Output& output, RobotLimits& limits, int& exit_code) {
  Client client(options, output);
  if (!client.connect()) {
    exit_code = client.exit_code();
    return false;
  }
  const Welcome& welcome = client.welcome();
  limits.robot = welcome.robot();
  limits.joints = joint_names(welcome);
  limits.resize(welcome.joints_size());
  for (int k = 0; k < welcome.joints_size(); ++k) {
    const Joint& joint = welcome.joints(k);
    limits.lowest[k] = joint.min_rad();
    limits.highest[k] = joint.max_rad();
    limits.bounds.v[k] = joint.velocity();
    limits.bounds.a[k] = joint.acceleration();
    limits.bounds.j[k] = joint.jerk();
  }
  return true;
}

bool refuse(Output& output, const std::string& text, int& exit_code) {
  exit_code = kRefused;
  output.error(text, exit_code);
  return false;
}

bool find_limits(const Options& options, Output& output, RobotLimits& limits, int& exit_code) {
  if (options.robot.empty() && options.connect.empty())
    return refuse(output, "retime needs limits; give --robot fer, gen3 or ur10, or --connect",
                  exit_code);
  if (options.robot.empty()) return ask_server(options, output, limits, exit_code);
  if (use_table<Fer>(options.robot, limits) || use_table<Gen3>(options.robot, limits) ||
      use_table<Ur10>(options.robot, limits))
    return true;
  return refuse(output, "--robot " + options.robot + ": unknown robot; write fer, gen3 or ur10",
                exit_code);
}

bool read_path(const Options& options, const RobotLimits& limits, Output& output,
               std::vector<Joints>& path, int& exit_code) {
  RowReader reader;
  if (!reader.open(options.file, limits.joints, {true, false}))
    return refuse(output, reader.error(), exit_code);
  if (reader.form().poses)
    return refuse(output, options.file + ": a path of the tip; give positions of the joints",
                  exit_code);
  Row row;
  RowTaken taken = RowTaken::kRow;
  while ((taken = reader.next(row)) == RowTaken::kRow) {
    const auto count = static_cast<Eigen::Index>(limits.joints.size());
    path.emplace_back(Eigen::Map<const Eigen::ArrayXd>(row.numbers.data(), count));
    for (Eigen::Index k = 0; k < count; ++k) {
      const double q = path.back()[k];
      if (q >= limits.lowest[k] && q <= limits.highest[k]) continue;
      return refuse(output,
                    options.file + ":" + std::to_string(reader.line()) + ": " +
                        limits.joints[static_cast<std::size_t>(k)] +
                        formatted(": %.6g rad is not", q) +
                        formatted(" from %.6g", limits.lowest[k]) +
                        formatted(" to %.6g rad; plan inside of the range", limits.highest[k]),
                    exit_code);
    }
  }
  return taken == RowTaken::kEnd || refuse(output, reader.error(), exit_code);
}

void write_group(std::FILE* file, const Joints& values) {
  for (const double value : values) std::fprintf(file, ",%.17g", value);
}

bool write_trajectory(const Options& options, const RobotLimits& limits,
                      const std::vector<TimedPoint>& points) {
  std::FILE* file = options.out == "-" ? stdout : std::fopen(options.out.c_str(), "wb");
  if (file == nullptr) return false;
  std::fprintf(file, "# %s retimed for %s by tactusctl\ntime_s", options.file.c_str(),
               limits.robot.c_str());
  const int count = static_cast<int>(limits.joints.size());
  for (int k = 1; k <= count; ++k) std::fprintf(file, ",q%d_rad", k);
  for (int k = 1; k <= count; ++k) std::fprintf(file, ",dq%d_rad_s", k);
  for (int k = 1; k <= count && options.jerk; ++k) std::fprintf(file, ",ddq%d_rad_s2", k);
  std::fputc('\n', file);
  for (const TimedPoint& point : points) {
    std::fprintf(file, "%.17g", point.time_s);
    write_group(file, point.q);
    write_group(file, point.dq);
    if (options.jerk) write_group(file, point.ddq);
    std::fputc('\n', file);
  }
  const bool good = std::ferror(file) == 0;
  return (file == stdout ? std::fflush(file) : std::fclose(file)) == 0 && good;
}

}  // namespace

int retime_path(const Options& options, Output& output) {
  int exit_code = kSucceeded;
  RobotLimits limits;
  std::vector<Joints> path;
  if (!find_limits(options, output, limits, exit_code) ||
      !read_path(options, limits, output, path, exit_code))
    return exit_code;
  RetimeSettings settings;
  settings.bounds = {limits.bounds.v * options.velocity_scale,
                     limits.bounds.a * options.acceleration_scale,
                     limits.bounds.j * options.acceleration_scale};
  settings.corners = {options.tolerance_rad, options.radius_rad};
  settings.jerk = options.jerk;
  const std::vector<TimedPoint> points = retime(path, settings);
  if (points.empty()) {
    refuse(output, options.file + ": no way to go; give at least two different waypoints",
           exit_code);
  } else if (!write_trajectory(options, limits, points)) {
    refuse(output, options.out + ": " + std::strerror(errno) + "; give a file that can be written",
           exit_code);
  } else {
    std::fprintf(stderr, "%s: %zu waypoints, %.4f s for %s\n", options.out.c_str(), points.size(),
                 points.back().time_s, limits.robot.c_str());
  }
  return exit_code;
}

}  // namespace tactus::ctl
