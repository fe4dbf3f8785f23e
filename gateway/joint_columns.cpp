// The columns of the joints: prefix, number or name of the joint, unit.
#include "gateway/trajectory_columns.hpp"

namespace tactus {
namespace {

struct GroupWords {
  std::string_view prefix, suffix;
};

// In the order of the groups, from the positions on; the joint is between prefix and suffix.
constexpr std::array<GroupWords, 4> kGroupWords = {{
    {"q", "_rad"},
    {"dq", "_rad_s"},
    {"ddq", "_rad_s2"},
    {"tau", "_Nm"},
}};

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

}  // namespace

bool ColumnTable<JointSpace>::find(std::string_view header, ColumnPlace& place) {
  for (std::size_t i = 0; i < kGroupWords.size(); ++i) {
    const GroupWords& words = kGroupWords[i];
    if (!starts_with(header, words.prefix) || !ends_with(header, words.suffix)) continue;
    std::string_view word = header;
    word.remove_prefix(words.prefix.size());
    if (word.size() < words.suffix.size()) continue;
    word.remove_suffix(words.suffix.size());
    place = {static_cast<int>(i) + 1, joint_of(word)};
    if (place.index >= 0) return true;
  }
  return false;
}

double& ColumnTable<JointSpace>::value(const ColumnPlace& place, JointSpace::Point& point) {
  JointVector* const groups[] = {&point.q, &point.dq, &point.ddq, &point.tau};
  return (*groups[place.group - 1])[place.index];
}

void ColumnTable<JointSpace>::name_them(Message& message) {
  message << "q1_rad, dq1_rad_s, ddq1_rad_s2, tau1_Nm, up to joint " << kDof;
}

}  // namespace tactus
