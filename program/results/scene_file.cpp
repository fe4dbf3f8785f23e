#include "program/results/scene_file.hpp"

#include "kernel/guard/convex.hpp"
#include "program/results/result_file.hpp"

namespace tactus {
namespace {

/// Writes "key": [numbers].
void write_numbers(std::FILE* file, const char* key, const double* numbers, long count) {
  std::fprintf(file, "\"%s\": [", key);
  for (long i = 0; i < count; ++i) std::fprintf(file, i > 0 ? ", %.9g" : "%.9g", numbers[i]);
  std::fprintf(file, "]");
}

void write_frame(std::FILE* file, const JointFrame& frame) {
  std::fprintf(file, "[%.9g, %.9g, %.9g, %.9g, %.9g, %d]", frame.x, frame.y, frame.z, frame.roll(),
               frame.turn, frame.type == JointType::kPrismatic);
}

void write_arm(std::FILE* file) {
  std::fprintf(file, "  \"joints\": [");
  for (std::size_t i = 0; i < Robot::kJoints.size(); ++i) {
    std::fprintf(file, i > 0 ? ",\n    " : "\n    ");
    write_frame(file, Robot::kJoints[i]);
  }
  std::fprintf(file, "\n  ],\n  \"flange\": ");
  write_frame(file, Robot::kFlange);
  std::fprintf(file, ",\n  \"links\": [");
  const char* separator = "";
  for (const char* const link : RobotCapsules::kLinkNames) {
    std::fprintf(file, "%s\"%s\"", separator, link);
    separator = ", ";
  }
  std::fprintf(file, "],\n  \"capsules\": [");
  separator = "\n    ";
  for (const LinkCapsule& capsule : RobotCapsules::kCapsules) {
    std::fprintf(file, "%s{\"link\": %d, ", separator, capsule.link);
    write_numbers(file, "a", capsule.a, 3);
    std::fprintf(file, ", ");
    write_numbers(file, "b", capsule.b, 3);
    std::fprintf(file, ", \"radius\": %.9g}", capsule.radius);
    separator = ",\n    ";
  }
  std::fprintf(file, "\n  ],\n");
}

void write_points(std::FILE* file, const Hull& hull, const Vector3& origin) {
  std::fprintf(file, "\"points\": [");
  for (int i = 0; i < hull.count(); ++i) {
    const Vector3 point = hull[i] - origin;
    std::fprintf(file, "%s[%.9g, %.9g, %.9g]", i > 0 ? ", " : "", point.x(), point.y(), point.z());
  }
  std::fprintf(file, "]");
}

/// The body inside a box: points in its axes, from its centre, or half the size of a cylinder.
void write_inside(std::FILE* file, const Convex& body) {
  constexpr const char* kCores[] = {"segment", "box", "cylinder", "hull"};
  std::fprintf(file, ", \"inside\": {\"core\": \"%s\", \"rounding\": %.9g, ",
               kCores[static_cast<std::size_t>(body.core)], body.rounding);
  write_numbers(file, "half", body.half.data(), 3);
  std::fprintf(file, ", ");
  write_points(file, body.hull != nullptr ? *body.hull : Hull(), body.middle);
  std::fprintf(file, "}");
}

void write_boxes(std::FILE* file, const PortTable& ports) {
  std::fprintf(file, "  \"boxes\": [");
  const char* separator = "\n    ";
  for (int i = 0; i < ports.count(); ++i) {
    if (ports[i].quantity != Quantity::kBox) continue;
    const Cuboid& box = *static_cast<const Cuboid*>(ports[i].value);
    const Eigen::Quaterniond& r = box.pose.r;
    const double rotation[] = {r.w(), r.x(), r.y(), r.z()};
    std::fprintf(file, "%s{\"name\": \"%s\", ", separator, ports[i].block.c_str());
    write_numbers(file, "centre", box.pose.p.data(), 3);
    std::fprintf(file, ", ");
    write_numbers(file, "rotation", rotation, 4);
    std::fprintf(file, ", ");
    write_numbers(file, "size", box.size.data(), 3);
    if (box.inside != nullptr) write_inside(file, *box.inside);
    std::fprintf(file, "}");
    separator = ",\n    ";
  }
  std::fprintf(file, "\n  ],\n");
}

void write_hulls(std::FILE* file, const CollisionSection& collision) {
  std::fprintf(file, "  \"hulls\": [");
  const char* separator = "\n    ";
  for (int link = 0; link < LinkHulls::kMost; ++link) {
    if (collision.link_points[link].count() == 0) continue;
    std::fprintf(file, "%s{\"link\": %d, \"rounding\": %.9g, ", separator, link,
                 collision.link_rounding);
    write_points(file, collision.link_points[link], Vector3::Zero());
    std::fprintf(file, "}");
    separator = ",\n    ";
  }
  std::fprintf(file, "\n  ],\n");
}

void write_limits(std::FILE* file, const JointLimits& limits) {
  const struct {
    const char* key;
    const JointVector& values;
  } all[] = {{"q_min", limits.q_min},
             {"q_max", limits.q_max},
             {"dq_max", limits.dq_max},
             {"ddq_max", limits.ddq_max},
             {"tau_max", limits.tau_max}};
  std::fprintf(file, "  \"limits\": {");
  const char* separator = "\n    ";
  for (const auto& limit : all) {
    std::fprintf(file, "%s", separator);
    write_numbers(file, limit.key, limit.values.data(), kDof);
    separator = ",\n    ";
  }
  std::fprintf(file, "\n  }\n");
}

}  // namespace

bool write_scene(const char* path, const Pipeline& pipeline) {
  ResultFile result;
  if (!result.open(path)) return false;
  std::FILE* const file = result.stream();
  std::fprintf(file, "{\n  \"robot\": \"%s\",\n", Robot::kName);
  write_arm(file);
  std::fprintf(file, "  \"tool\": {");
  write_numbers(file, "tip", pipeline.robot.tool.value.tip.p.data(), 3);
  std::fprintf(file, ", \"radius\": %.9g, ", pipeline.collision.tool_radius);
  write_points(file, pipeline.collision.tool_points, Vector3::Zero());
  std::fprintf(file, "},\n");
  write_hulls(file, pipeline.collision);
  write_boxes(file, pipeline.ports);
  write_limits(file, pipeline.guard.limits);
  std::fprintf(file, "}\n");
  return result.close();
}

}  // namespace tactus
