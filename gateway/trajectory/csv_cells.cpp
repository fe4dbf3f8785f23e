#include "gateway/trajectory/csv_cells.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "kernel/load/ini.hpp"

namespace tactus {
namespace {

/// A unit that files may use in place of one of SI.
struct Unit {
  std::string_view name, si;
  double scale;  // SI units in one of it
};

constexpr double kPi = 3.14159265358979323846;
constexpr std::array<Unit, 3> kUnits = {
    {{"_deg", "_rad", kPi / 180.0}, {"_mm", "_m", 1e-3}, {"_ms", "_s", 1e-3}}};

}  // namespace

bool Cells::take(std::string_view& cell) {
  if (!more_) return false;
  const std::size_t end = row_.find(separator_);
  more_ = end != std::string_view::npos;
  cell = trim(row_.substr(0, end));
  row_.remove_prefix(more_ ? end + 1 : row_.size());
  return true;
}

char separator_of(std::string_view header) {
  for (const char separator : {';', '\t'})
    if (header.find(separator) != std::string_view::npos) return separator;
  return ',';
}

bool read_number(std::string_view cell, double& value) {
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  const char* end = cell.data() + cell.size();
  const auto [stop, code] = std::from_chars(cell.data(), end, value);
  return code == std::errc() && stop == end && std::isfinite(value);
}

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

const char* not_a_column(std::string_view header) {
  double number = 0.0;
  if (header.find(' ') != std::string_view::npos)
    return "blanks separate no columns; write commas, semicolons or tabs";
  return read_number(header, number)
             ? "a number in the first row, which must name the columns; add a row of names"
             : "unknown column";
}

Name in_si(std::string_view header, double& scale) {
  scale = 1.0;
  for (const Unit& unit : kUnits) {
    const std::size_t at = header.find(unit.name);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = header.substr(at + unit.name.size());
    if (!rest.empty() && rest.front() != '_') continue;
    scale = unit.scale;
    Name changed(header.substr(0, at));
    changed << unit.si << rest;
    return changed;
  }
  return Name(header);
}

}  // namespace tactus
