#include "kernel/core/hull.hpp"
#include "kernel/load/ini.hpp"
#include "kernel/load/number.hpp"

namespace tactus {
namespace {

/// Reads "x y z" and nothing else.
Status read_point(std::string_view text, Vector3& point, Message& why) {
  constexpr Range kRange = {-10.0, 10.0};
  std::string_view rest = text;
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = take_word(rest);
    if (word.empty()) {
      why << "'" << trim(text) << "' is " << i << " numbers; a point is 3, m";
      return Status::kBadValue;
    }
    if (!parse_number(word, point[i])) {
      why << "'" << word << "' is not a finite number";
      return Status::kBadValue;
    }
    if (kRange.contains(point[i])) continue;
    why << point[i] << " m is out of range; it must be " << kRange;
    return Status::kBadValue;
  }
  if (trim(rest).empty()) return Status::kOk;
  why << "'" << trim(rest)
      << "' is too much; a point is 3 numbers, m, and a comma is before the next";
  return Status::kBadValue;
}

}  // namespace

Status Hull::add(std::string_view text, int /*line*/, Message& why) {
  for (bool more = true; more;) {
    const std::string_view item = take_item(text, more);
    if (count_ == kMost) {
      why << "more than " << kMost << " points; scripts/hull makes fewer of them";
      return Status::kTooLarge;
    }
    Vector3 point;
    const Status status = read_point(item, point, why);
    if (status != Status::kOk) return status;
    points_[static_cast<std::size_t>(count_++)] = point;
  }
  return Status::kOk;
}

Status LinkHulls::add(std::string_view text, int line, Message& why) {
  const std::string_view name = take_word(text);
  for (std::size_t link = 0; link < hulls_.size(); ++link)
    if (name == RobotCapsules::kLinkNames[link]) return hulls_[link].add(text, line, why);
  why << "unknown link '" << name << "'; expected one of ";
  for (std::size_t link = 0; link < hulls_.size(); ++link)
    why << (link > 0 ? ", " : "") << RobotCapsules::kLinkNames[link];
  return Status::kBadValue;
}

}  // namespace tactus
