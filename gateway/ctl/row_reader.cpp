#include "gateway/ctl/row_reader.hpp"

#include <array>
#include <cerrno>
#include <cstring>

#include "gateway/trajectory/csv_cells.hpp"
#include "kernel/load/ini.hpp"

namespace tactus::ctl {
namespace {

enum Group { kTime, kPosition, kVelocity, kAcceleration, kEffort, kGroups };
constexpr std::array<const char*, kGroups> kMeanings = {"time", "position", "velocity",
                                                        "acceleration", "effort"};

struct Words {
  const char *prefix, *suffix, *prismatic;  // the last in place of the suffix
};
constexpr std::array<Words, kGroups> kJointWords = {{{"", "", ""},
                                                     {"q", "_rad", "_m"},
                                                     {"dq", "_rad_s", "_m_s"},
                                                     {"ddq", "_rad_s2", "_m_s2"},
                                                     {"tau", "_Nm", "_N"}}};

using Headers = std::array<const char*, 7>;
constexpr std::array<Headers, kGroups> kTipHeaders = {{
    {},
    {"x_m", "y_m", "z_m", "qw", "qx", "qy", "qz"},
    {"vx_m_s", "vy_m_s", "vz_m_s", "wx_rad_s", "wy_rad_s", "wz_rad_s"},
    {"ax_m_s2", "ay_m_s2", "az_m_s2", "alphax_rad_s2", "alphay_rad_s2", "alphaz_rad_s2"},
    {"fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"},
}};

constexpr int kTip = 1000;  // added to the index of a column of the tip

std::uint32_t whole(int count) {
  return (std::uint32_t{1} << count) - 1;
}

}  // namespace

bool RowReader::refuse(int line, int column, std::string_view header, std::string_view reason) {
  error_ = path_ + ":";
  if (line > 0) error_ += std::to_string(line) + ":";
  if (column > 0) error_ += std::to_string(column) + ":";
  error_ += " ";
  if (!header.empty()) error_.append(header).append(": ");
  error_.append(reason);
  return false;
}

bool RowReader::open(const std::string& path, const std::vector<JointName>& joints,
                     const Allow& allow) {
  const bool input = path == "-";
  path_ = input ? "standard input" : path;
  joints_ = joints;
  allow_ = allow;
  if (!lines_->open(input ? "/dev/stdin" : path.c_str(), 0))
    return refuse(0, 0, {}, std::string(std::strerror(errno)) + "; give the path of a CSV file");
  std::string_view line;
  switch (next_line(line, -1)) {
    case RowResult::kRow: return read_header(line);
    case RowResult::kEnd:
      return refuse(0, 0, {}, "the file has no header; write q1_rad,q2_rad,...");
    default: return false;
  }
}

bool RowReader::rewind() {
  std::string_view header;
  return (lines_->rewind() && next_line(header, -1) == RowResult::kRow) ||
         refuse(0, 0, {}, "the file cannot be read a second time");
}

RowResult RowReader::next_line(std::string_view& line, int wait_ms) {
  for (;;) {
    switch (lines_->next(line, wait_ms)) {
      case LineReader::Result::kLine: break;
      case LineReader::Result::kNotYet: return RowResult::kNotYet;
      case LineReader::Result::kEnd: return RowResult::kEnd;
      case LineReader::Result::kTooLong:
        refuse(lines_->line(), 0, {}, "the line is too long; is this a CSV file?");
        return RowResult::kRefused;
      case LineReader::Result::kFailed:
        refuse(0, 0, {}, std::string(std::strerror(errno)) + "; give the path of a CSV file");
        return RowResult::kRefused;
    }
    if (!is_text(line)) {
      refuse(lines_->line(), 0, {}, kNotText);
      return RowResult::kRefused;
    }
    if (lines_->line() == 1) line = without_byte_order_mark(line);
    const std::string_view content = trim(line);
    if (!content.empty() && content.front() != '#') return RowResult::kRow;
  }
}

bool RowReader::read_header(std::string_view line) {
  columns_.clear();
  separator_ = separator_of(line);
  Cells cells(line, separator_);
  for (std::string_view cell; cells.take(cell);)
    if (!add(cell)) return false;
  return complete();
}

bool RowReader::find(const std::string& si, Column& column) const {
  if (si == "time_s") return true;
  for (column.group = kPosition; column.group < kGroups; ++column.group) {
    const auto group = static_cast<std::size_t>(column.group);
    const Words& words = kJointWords[group];
    for (std::size_t i = 0; i < joints_.size(); ++i) {
      column.index = static_cast<int>(i);
      const char* const suffix = joints_[i].prismatic ? words.prismatic : words.suffix;
      if (si == words.prefix + std::to_string(i + 1) + suffix) return true;
      if (si == words.prefix + ("_" + joints_[i].name) + suffix) return true;
    }
    for (std::size_t i = 0; i < kTipHeaders[group].size(); ++i) {
      column.index = kTip + static_cast<int>(i);
      if (kTipHeaders[group][i] != nullptr && si == kTipHeaders[group][i]) return true;
    }
  }
  return false;
}

bool RowReader::add(std::string_view header) {
  const int number = static_cast<int>(columns_.size()) + 1, line = lines_->line();
  Column column;
  column.header = std::string(header);
  const std::string si{std::string_view(in_si(header, column.scale))};
  if (!find(si, column))
    return refuse(line, number, header,
                  std::string(not_a_column(header)) +
                      "; write time_s, q1_rad, dq1_rad_s, ddq1_rad_s2, tau1_Nm, up to joint " +
                      std::to_string(joints_.size()) +
                      ", of a prismatic one q1_m and so on; or x_m .. qz of the tip");
  for (const Column& earlier : columns_)
    if (earlier.group == column.group && earlier.index == column.index)
      return refuse(line, number, header, "the column is given twice; remove one");
  columns_.push_back(column);
  return true;
}

bool RowReader::some_or_all(int group, std::uint32_t found) {
  const int width = group == kPosition ? form_.position() : form_.derivative();
  const std::uint32_t expected = whole(width) & ~form_.held_joints;
  if (found == expected) return true;
  return refuse(
      lines_->line(), 0, kMeanings[static_cast<std::size_t>(group)],
      "some columns are missing; give all " + std::to_string(width) +
          (form_.poses ? "" : ", or some joints, the same in every group, with --partial"));
}

bool RowReader::complete() {
  std::array<std::uint32_t, kGroups> found{};
  bool tip = false, joint = false;
  for (const Column& column : columns_) {
    tip |= column.index >= kTip;
    joint |= column.group != kTime && column.index < kTip;
    found[static_cast<std::size_t>(column.group)] |= std::uint32_t{1} << (column.index % kTip);
  }
  const int line = lines_->line();
  if (tip && joint)
    return refuse(line, 0, {}, "columns of joints and of the tip; give one of both");
  if (found[kPosition] == 0)
    return refuse(line, 0, {}, "no positions; give q1_rad or x_m and so on");
  form_ = {found[kTime] != 0,
           tip,
           found[kVelocity] != 0,
           found[kAcceleration] != 0,
           found[kEffort] != 0,
           static_cast<int>(joints_.size()),
           0};
  if (!form_.times && !allow_.no_times) return refuse(line, 0, "time_s", "the column is missing");
  if (form_.accelerations && !form_.velocities)
    return refuse(line, 0, {}, "accelerations without velocities; give both or none");
  if (allow_.partial && joint) form_.held_joints = whole(form_.joints) & ~found[kPosition];
  for (int group = kPosition; group < kGroups; ++group) {
    const std::uint32_t given = found[static_cast<std::size_t>(group)];
    if (given != 0 && !some_or_all(group, given)) return false;
  }
  std::array<int, kGroups> begin{};
  for (int group = kVelocity, at = form_.position(); group < kGroups; ++group) {
    begin[static_cast<std::size_t>(group)] = at;
    if (found[static_cast<std::size_t>(group)] != 0) at += form_.derivative();
  }
  for (Column& column : columns_)
    column.place = static_cast<std::size_t>(begin[static_cast<std::size_t>(column.group)]) +
                   static_cast<std::size_t>(column.index % kTip);
  return true;
}

RowResult RowReader::next(Row& row, int wait_ms) {
  std::string_view line;
  const RowResult taken = next_line(line, wait_ms);
  if (taken != RowResult::kRow) return taken;
  return read_row(line, row) ? RowResult::kRow : RowResult::kRefused;
}

bool RowReader::read_row(std::string_view line, Row& row) {
  row.numbers.assign(static_cast<std::size_t>(form_.numbers()), 0.0);
  Cells cells(line, separator_);
  std::size_t count = 0;
  const int number = lines_->line();
  for (std::string_view cell; cells.take(cell); ++count) {
    if (count == columns_.size())
      return refuse(number, static_cast<int>(count) + 1, {},
                    "more cells than columns of the header; decimals are written with a point");
    const Column& column = columns_[count];
    double value = 0.0;
    if (!read_number(cell, value))
      return refuse(number, static_cast<int>(count) + 1, column.header, not_a_number(cell));
    (column.group == kTime ? row.time_s : row.numbers[column.place]) = value * column.scale;
  }
  return count == columns_.size() ||
         refuse(number, 0, {}, "fewer cells than columns of the header; write every number");
}

}  // namespace tactus::ctl
