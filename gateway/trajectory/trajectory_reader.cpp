#include "gateway/trajectory/trajectory_reader.hpp"

#include <cerrno>
#include <cstring>
#include <type_traits>

#include "gateway/trajectory/csv_cells.hpp"
#include "kernel/load/ini.hpp"

namespace tactus {
namespace {

bool refuse(CsvError& error, int line, int column, std::string_view header,
            std::string_view reason) {
  error.line = line;
  error.column = column;
  error.header = Name(header);
  error.reason = Message(reason);
  return false;
}

template <class Space>
bool read_header(Cells cells, int line, Columns<Space>& columns, CsvError& error) {
  std::string_view cell;
  for (int column = 1; cells.take(cell); ++column) {
    Message reason;
    if (!columns.add(cell, reason)) return refuse(error, line, column, cell, reason);
  }
  Message reason;
  return columns.complete(reason) || refuse(error, line, 0, {}, reason);
}

Message not_readable(int error) {
  return Message(std::strerror(error)) << "; give the path of a trajectory file";
}

template <class Space>
bool read_row(Cells cells, int line, const Columns<Space>& columns, Digits* digits,
              Waypoint<Space>& waypoint, CsvError& error) {
  waypoint = {};
  std::string_view cell;
  int number = 0, column = 0;
  while (cells.take(cell)) {
    if (++number > columns.cells()) {
      return refuse(error, line, number, {},
                    Message("more cells than the ") << columns.cells()
                                                    << " columns of the header; "
                                                       "decimals are written with a point");
    }
    if (!columns.is_at(column, number)) continue;
    const std::string_view header = columns.name(column);
    if (cell.empty()) return refuse(error, line, number, header, "the cell is empty");
    double& value = columns.value(column, waypoint);
    if (!read_number(cell, value)) return refuse(error, line, number, header, not_a_number(cell));
    value *= columns.scale(column);
    digits[column++].note(cell);
  }
  if (number == columns.cells()) return true;
  return refuse(
      error, line, 0, {},
      Message("") << number << " cells, but the header has " << columns.cells() << " columns");
}

}  // namespace

PlacedMessage CsvError::message() const {
  PlacedMessage text;
  if (line > 0) text << line << ":";
  if (column > 0) text << column << ":";
  if (line > 0) text << " ";
  if (!header.empty()) text << header << ": ";
  text << reason;
  return text;
}

template <class Space>
bool TrajectoryReader<Space>::open(const char* path, bool partial, std::uint64_t hash,
                                   CsvError& error) {
  error = {};
  columns_ = Columns<Space>(partial);
  digits_.fill({});
  partial_ = partial;
  rows_ = 0;
  turns_.restart();
  return lines_.open(path, hash) || refuse(error, 0, 0, {}, not_readable(errno));
}

template <class Space>
bool TrajectoryReader<Space>::rewind(CsvError& error) {
  error = {};
  columns_ = Columns<Space>(partial_);
  rows_ = 0;
  turns_.restart();
  return lines_.rewind() || refuse(error, 0, 0, {}, not_readable(errno));
}

template <class Space>
RowResult TrajectoryReader<Space>::next(Waypoint<Space>& waypoint, CsvError& error, int wait_ms) {
  std::string_view row;
  for (;;) {
    switch (lines_.next(row, wait_ms)) {
      case LineReader::Result::kLine: break;
      case LineReader::Result::kNotYet: return RowResult::kNotYet;
      case LineReader::Result::kEnd: return end(error);
      case LineReader::Result::kTooLong:
        refuse(error, lines_.line(), 0, {},
               Message("the line is longer than ") << LineReader::kLongest << " characters");
        return RowResult::kRefused;
      case LineReader::Result::kFailed:
        refuse(error, 0, 0, {}, not_readable(errno));
        return RowResult::kRefused;
    }
    const int line = lines_.line();
    if (!is_text(row)) {
      refuse(error, line, 0, {}, kNotText);
      return RowResult::kRefused;
    }
    if (line == 1) row = without_byte_order_mark(row);
    const std::string_view content = trim(row);
    if (content.empty() || content.front() == '#') continue;
    if (columns_.count() > 0) {
      rows_ += 1;
      const bool read =
          read_row(Cells(row, separator_), line, columns_, digits_.data(), waypoint, error);
      if (read) turns_.take(waypoint.point);
      return read ? RowResult::kWaypoint : RowResult::kRefused;
    }
    separator_ = separator_of(row);
    if (!read_header(Cells(row, separator_), line, columns_, error)) return RowResult::kRefused;
    JointSpace::Header header;
    if constexpr (std::is_same_v<Space, JointSpace>) columns_.note_terms(header);
    turns_.leave_out(header);
  }
}

template <class Space>
Waypoint<Space> TrajectoryReader<Space>::half_units(const Waypoint<Space>& waypoint) const {
  Waypoint<Space> given = waypoint, half;
  half.point = waypoint.point;
  for (int column = 0; column < columns_.count(); ++column) {
    const double scale = columns_.scale(column), number = columns_.value(column, given) / scale;
    const Digits& digits = digits_[static_cast<std::size_t>(column)];
    columns_.value(column, half) = scale * digits.half_unit(number);
  }
  return half;
}

template <class Space>
RowResult TrajectoryReader<Space>::end(CsvError& error) const {
  if (columns_.count() > 0 && rows_ > 0) return RowResult::kEnd;
  refuse(error, 0, 0, {},
         columns_.count() == 0 ? "the file has no header" : "the file has no waypoints");
  return RowResult::kRefused;
}

template class TrajectoryReader<JointSpace>;
template class TrajectoryReader<TaskSpace>;

template <class Space>
bool read_trajectory(const char* path, bool partial, Trajectory<Space>& trajectory,
                     CsvError& error) {
  TrajectoryReader<Space> reader;
  trajectory.count = 0;
  if (!reader.open(path, partial, 0, error)) return false;
  Waypoint<Space> waypoint;
  RowResult taken = reader.next(waypoint, error);
  for (; taken == RowResult::kWaypoint; taken = reader.next(waypoint, error)) {
    if (trajectory.count == trajectory.capacity) {
      error.line = reader.lines().line();
      error.reason << "too many waypoints; at most " << trajectory.capacity << " fit";
      return false;
    }
    trajectory.set(trajectory.count++, waypoint);
  }
  trajectory.fields = reader.fields();
  reader.note_terms(trajectory.header);
  return taken == RowResult::kEnd;
}

template bool read_trajectory(const char*, bool, Trajectory<JointSpace>&, CsvError&);
template bool read_trajectory(const char*, bool, Trajectory<TaskSpace>&, CsvError&);

}  // namespace tactus
