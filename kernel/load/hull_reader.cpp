#include "kernel/core/hull.hpp"
#include "kernel/load/ini.hpp"
#include "kernel/load/number.hpp"

namespace tactus {

Status Hull::add(std::string_view text, int /*line*/, Message& why) {
  constexpr Range kRange = {-10.0, 10.0};
  if (count_ == kMost) {
    why << "more than " << kMost << " points; scripts/hull makes fewer of them";
    return Status::kTooLarge;
  }
  Vector3 point;
  for (int i = 0; i < 3; ++i) {
    const std::string_view word = take_word(text);
    if (!parse_number(word, point[i])) {
      why << "'" << word << "' is not a finite number; a point is 3 numbers, m";
      return Status::kBadValue;
    }
    if (kRange.contains(point[i])) continue;
    why << point[i] << " m is out of range; it must be " << kRange;
    return Status::kBadValue;
  }
  if (!trim(text).empty()) {
    why << "'" << trim(text) << "' is too much; a point is 3 numbers, m";
    return Status::kBadValue;
  }
  points_[static_cast<std::size_t>(count_++)] = point;
  return Status::kOk;
}

}  // namespace tactus
