#include "gateway/trajectory_csv.hpp"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "gateway/trajectory_columns.hpp"
#include "kernel/load/ini.hpp"

namespace tactus {
namespace {

constexpr std::size_t kMaxRowLength = 4096;
using Row = std::array<char, kMaxRowLength>;

/// Cuts a row into cells.
class Cells {
 public:
  Cells(std::string_view row, char separator) : row_(row), separator_(separator) {}

  /// Takes the next cell; false if none is left.
  bool take(std::string_view& cell) {
    if (!more_) return false;
    const std::size_t end = row_.find(separator_);
    more_ = end != std::string_view::npos;
    cell = trim(row_.substr(0, end));
    row_.remove_prefix(more_ ? end + 1 : row_.size());
    return true;
  }

 private:
  std::string_view row_;
  char separator_;
  bool more_ = true;
};

/// Returns what separates the cells of a file: a semicolon or a tab if its header has one.
char separator_of(std::string_view header) {
  for (const char separator : {';', '\t'})
    if (header.find(separator) != std::string_view::npos) return separator;
  return ',';
}

bool refuse(CsvError& error, int line, int column, std::string_view header,
            std::string_view reason) {
  error.line = line;
  error.column = column;
  error.header = Name(header);
  error.reason = Message(reason);
  return false;
}

bool read_number(std::string_view cell, double& value) {
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  const char* end = cell.data() + cell.size();
  const auto [stop, code] = std::from_chars(cell.data(), end, value);
  return code == std::errc() && stop == end && std::isfinite(value);
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

/// Explains a cell that is not a number.
Message not_a_number(std::string_view cell) {
  Message reason("'");
  reason << cell << "' is not a finite number";
  const std::size_t comma = cell.find(',');
  if (comma != std::string_view::npos && cell.find(',', comma + 1) == std::string_view::npos)
    reason << "; write " << cell.substr(0, comma) << "." << cell.substr(comma + 1);
  else
    reason << "; write a number such as -0.5";
  return reason;
}

Message not_readable(int error) {
  return Message(std::strerror(error)) << "; give the path of a trajectory file";
}

template <class Space>
bool read_row(Cells cells, int line, const Columns<Space>& columns, Waypoint<Space>& waypoint,
              CsvError& error) {
  waypoint = {};
  std::string_view cell;
  int column = 0;
  while (cells.take(cell)) {
    if (++column > columns.count()) {
      return refuse(error, line, column, {},
                    Message("more cells than the ") << columns.count()
                                                    << " columns of the header; "
                                                       "decimals are written with a point");
    }
    const std::string_view header = columns.name(column - 1);
    if (cell.empty()) return refuse(error, line, column, header, "the cell is empty");
    double& value = columns.value(column - 1, waypoint);
    if (!read_number(cell, value)) return refuse(error, line, column, header, not_a_number(cell));
    value *= columns.scale(column - 1);
  }
  if (column == columns.count()) return true;
  return refuse(
      error, line, 0, {},
      Message("") << column << " cells, but the header has " << columns.count() << " columns");
}

/// Reads one line without its end, up to the size of the buffer; false at the end of the file.
/// `fits` is false if the line is longer.
bool read_line(std::FILE* file, Row& buffer, std::string_view& line, bool& fits) {
  std::size_t size = 0;
  fits = true;
  int c = std::getc(file);
  if (c == EOF) return false;
  for (; c != EOF && c != '\n'; c = std::getc(file)) {
    fits = size < buffer.size();
    if (!fits) break;
    buffer[size++] = static_cast<char>(c);
  }
  line = std::string_view(buffer.data(), size);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

/// Reads the header if there is none yet, else the next waypoint.
template <class Space>
bool take_row(const Cells& row, int line, Columns<Space>& columns, Trajectory<Space>& trajectory,
              CsvError& error) {
  if (columns.count() == 0) return read_header(row, line, columns, error);
  if (trajectory.count == trajectory.capacity)
    return refuse(error, line, 0, {},
                  Message("too many waypoints; at most ") << trajectory.capacity << " fit");
  Waypoint<Space> waypoint;
  if (!read_row(row, line, columns, waypoint, error)) return false;
  trajectory.set(trajectory.count, waypoint);
  ++trajectory.count;
  return true;
}

template <class Space>
bool read_file(std::FILE* file, bool partial, Trajectory<Space>& trajectory, CsvError& error) {
  Row buffer;
  std::string_view row;
  bool fits = true;
  Columns<Space> columns(partial);
  char separator = ',';
  for (int line = 1; read_line(file, buffer, row, fits); ++line) {
    if (!fits)
      return refuse(error, line, 0, {},
                    Message("the line is longer than ") << kMaxRowLength << " characters");
    if (!is_text(row))
      return refuse(error, line, 0, {}, "the line contains bytes that are not text");
    if (line == 1) row = without_byte_order_mark(row);
    const std::string_view content = trim(row);
    if (content.empty() || content.front() == '#') continue;
    if (columns.count() == 0) separator = separator_of(row);
    if (!take_row(Cells(row, separator), line, columns, trajectory, error)) return false;
  }
  if (columns.count() == 0) return refuse(error, 0, 0, {}, "the file has no header");
  if (trajectory.count == 0) return refuse(error, 0, 0, {}, "the file has no waypoints");
  trajectory.fields = columns.fields();
  columns.note_left_out(trajectory.header);
  return true;
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
bool read_trajectory(const char* path, bool partial, Trajectory<Space>& trajectory,
                     CsvError& error) {
  error = {};
  trajectory.count = 0;
  std::FILE* file = std::fopen(path, "rb");
  if (file == nullptr) return refuse(error, 0, 0, {}, not_readable(errno));
  const bool read = read_file(file, partial, trajectory, error);
  const int failure = std::ferror(file) != 0 ? errno : 0;
  std::fclose(file);
  return failure == 0 ? read : refuse(error, 0, 0, {}, not_readable(failure));
}

template bool read_trajectory(const char*, bool, Trajectory<JointSpace>&, CsvError&);
template bool read_trajectory(const char*, bool, Trajectory<TaskSpace>&, CsvError&);

}  // namespace tactus
