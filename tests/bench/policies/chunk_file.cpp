#include "tests/bench/policies/chunk_file.hpp"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

namespace tactus {
namespace {

constexpr std::size_t kBefore = 5;  // columns before the position

/// Splits a row into its numbers. False if a cell is none.
bool numbers_of(const std::string& row, std::vector<double>& numbers) {
  numbers.clear();
  for (const char* cell = row.c_str();; ++cell) {
    char* end = nullptr;
    numbers.push_back(std::strtod(cell, &end));
    if (end == cell || !std::isfinite(numbers.back())) return false;
    cell = end;
    if (*cell == '\0') return true;
    if (*cell != ',') return false;
  }
}

/// Nanoseconds of a run are below 2^53, so a double holds them exactly.
std::int64_t ns(double number) {
  return static_cast<std::int64_t>(number);
}

void add_row(const std::vector<double>& row, std::vector<ChunkMessage>& chunks) {
  if (row[3] == 0.0) chunks.push_back({ns(row[0]), ns(row[1]), static_cast<unsigned>(row[2]), {}});
  const auto position = row.begin() + kBefore;
  chunks.back().points.push_back({ns(row[4]), {position, row.end() - 1}, row.back()});
}

}  // namespace

bool read_chunks(const char* path, int positions, std::vector<ChunkMessage>& chunks) {
  std::ifstream file(path);
  if (!file) {
    std::fprintf(stderr, "%s: %s\n", path, std::strerror(errno));
    return false;
  }
  const std::size_t columns = kBefore + static_cast<std::size_t>(positions) + 1;
  std::string text;
  std::vector<double> row;
  std::getline(file, text);
  for (int line = 2; std::getline(file, text); ++line) {
    if (numbers_of(text, row) && row.size() == columns && (!chunks.empty() || row[3] == 0.0)) {
      add_row(row, chunks);
      continue;
    }
    std::fprintf(stderr, "%s:%d: expected %zu numbers, step 0 first\n", path, line, columns);
    return false;
  }
  return true;
}

}  // namespace tactus
