#include "kernel/load/collision_reader.hpp"

namespace tactus {
namespace {

struct CollisionPlace {
  const Ini& ini;
  const IniSection& section;
  LoadError& error;

  Status refuse(Status status, const char* key, std::string_view reason) const {
    const IniEntry* entry = ini.find(section, key);
    return error.refuse(status, entry ? entry->line : section.line, section.name, key, reason);
  }
};

Status add_boxes(const PortTable& ports, CollisionScene& scene, const CollisionPlace& place) {
  for (int i = 0; i < ports.count(); ++i) {
    if (ports[i].quantity != Quantity::kBox) continue;
    const Name& name = ports[i].block;
    const int line = place.ini.find(name)->line;
    if (scene.body_count == kMaxBodies)
      return place.error.refuse(Status::kTooLarge, line, name, {},
                                Message("more than ")
                                    << kMaxObstacles << " bodies around the arm in the file");
    for (int body = 0; body < kFirstBoxBody; ++body)
      if (std::string_view(name) == scene.names[static_cast<std::size_t>(body)])
        return place.error.refuse(Status::kBadValue, line, name, {},
                                  "a body of the arm has this name; rename the block");
    scene.boxes[static_cast<std::size_t>(scene.box_count())] =
        static_cast<const Cuboid*>(ports[i].value);
    scene.names[static_cast<std::size_t>(scene.body_count++)] = ports[i].block.c_str();
  }
  return Status::kOk;
}

Message bodies(const CollisionScene& scene) {
  Message words;
  for (int i = 0; i < scene.body_count; ++i)
    words << (i > 0 ? ", " : "") << scene.names[static_cast<std::size_t>(i)];
  return words;
}

Status find_body(std::string_view name, const CollisionScene& scene, const CollisionPlace& place,
                 std::size_t& body) {
  for (body = 0; body < static_cast<std::size_t>(scene.body_count); ++body)
    if (name == scene.names[body]) return Status::kOk;
  return place.refuse(Status::kBadValue, "allow",
                      Message("unknown body '") << name << "'; expected one of " << bodies(scene));
}

/// Reads "tool table": two names and nothing else.
Status allow_pair(std::string_view pair, CollisionScene& scene, const CollisionPlace& place) {
  std::string_view rest = pair;
  const std::string_view first = take_word(rest), second = take_word(rest);
  if (second.empty() || !trim(rest).empty())
    return place.refuse(Status::kBadValue, "allow",
                        Message("'")
                            << trim(pair) << "' is not a pair of names; separate pairs by commas");
  std::size_t a = 0, b = 0;
  TRY(find_body(first, scene, place, a));
  TRY(find_body(second, scene, place, b));
  if (a == b)
    return place.refuse(Status::kBadValue, "allow",
                        Message("") << first << " is paired with itself");
  scene.allowed[a][b] = scene.allowed[b][a] = true;
  return Status::kOk;
}

/// Takes the braking the file gives, or the most there is; refuses more than that.
Status check_braking(const JointVector& most, const CollisionPlace& place, JointVector& braking) {
  if (place.ini.find(place.section, "braking") == nullptr) braking = most;
  for (int i = 0; i < kDof; ++i) {
    if (braking[i] <= most[i]) continue;
    return place.refuse(Status::kBadValue, "braking",
                        Message("joint ")
                            << i + 1 << ": " << braking[i] << " " << position_unit(i)
                            << "/s^2 is out of range; it brakes with at most " << most[i]);
  }
  return Status::kOk;
}

}  // namespace

Status read_collision(const Ini& ini, Pipeline& pipeline, LoadError& error) {
  const IniSection* section = ini.find("collision");
  if (section == nullptr) return Status::kOk;
  const CollisionPlace place{ini, *section, error};
  CollisionSection& collision = pipeline.collision;
  collision.present = true;
  if (kCheckedPositions % collision.cycles != 0)
    return place.refuse(Status::kBadValue, "cycles",
                        Message("")
                            << collision.cycles << " cycles do not share the " << kCheckedPositions
                            << " positions of a check evenly; give 1, 2, 5 or 10");
  if (collision.tool_points.count() > 0 && ini.find(*section, "tool_radius") == nullptr)
    collision.tool_radius = 0.0;
  if constexpr (kConvexBodies) {
    const int link = collision.misplaced_hull();
    if (link >= 0)
      return place.refuse(Status::kBadValue, "link_point",
                          Message("the hull of ")
                              << collision.scene.names[static_cast<std::size_t>(link)]
                              << " is not where the capsules of this link are; give all of the "
                                 "link, in its frame, in m");
  }
  const bool given = !collision.lateness.hasNaN(), of_torques = pipeline.robot.tau_c.wired();
  if (collision.compliance.hasNaN()) collision.compliance.setZero();
  if (!given && !of_torques) collision.lateness.setZero();
  if (collision.overshoot.hasNaN())
    collision.overshoot.setConstant(given || of_torques ? 1.0 : 0.0);
  TRY(check_braking(pipeline.deceleration(), place, collision.braking));
  TRY(add_boxes(pipeline.ports, collision.scene, place));
  std::string_view list = collision.allow;
  for (bool more = !list.empty(); more;)
    TRY(allow_pair(take_item(list, more), collision.scene, place));
  return Status::kOk;
}

}  // namespace tactus
