// Tables of files, each a case of its own: tests/refused, tests/hostile. In a table, a line
// "=== name" begins a case; its text follows, whose first line, "# expect: ...", is the refusal
// after the file's name ("..." at its end stands for the rest of a list). In a text, \xNN is a
// byte, and a \ at the end of a line joins it with the next. Where the first case is "base", the
// others say only what they change in it: a line "-..." is left out, "+..." is put there, " ..."
// says where.
#pragma once

#include <dirent.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string>
#include <string_view>

namespace tactus {

/// A case; its text is also in a file at `path`.
struct FileCase {
  std::string table, name, text;
  std::array<char, 40> path{};
  std::string_view expected;

  /// Whether `message` is as expected; prints both if not.
  bool expects(std::string_view message) const {
    constexpr std::string_view kRest = "...";
    const std::size_t begin = expected.rfind(kRest);
    const bool listed = begin != std::string_view::npos && begin + kRest.size() == expected.size();
    if (listed ? message.substr(0, begin) == expected.substr(0, begin) : message == expected)
      return true;
    std::fprintf(stderr, "  expected %.*s\n  got      %.*s\n", static_cast<int>(expected.size()),
                 expected.data(), static_cast<int>(message.size()), message.data());
    return false;
  }
};

/// Takes the first line, with its line break, from `text`.
inline std::string_view taken_line(std::string_view& text) {
  const std::string_view line = text.substr(0, std::min(text.find('\n'), text.size() - 1) + 1);
  text.remove_prefix(line.size());
  return line;
}

/// Adds `base` with `changes` to `text`. Returns false if one is not found in the base.
inline bool add_changed(std::string_view base, std::string_view changes, std::string& text) {
  while (!changes.empty()) {
    const std::string_view change = taken_line(changes), line = change.substr(1);
    const char how = change.front();
    if (how == '+') text += line;
    if (how == '+' || how == '\n') continue;
    if (how != '-' && how != ' ') return false;
    std::string_view kept;
    do {
      if (base.empty()) return false;
      kept = taken_line(base);
      if (kept != line || how == ' ') text += kept;
    } while (kept != line);
  }
  text += base;
  return true;
}

/// Puts bytes in place of their escapes. Returns false if a backslash begins none.
inline bool unescape(std::string& text) {
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at)) {
    const char* const begin = text.c_str() + at + 1;
    unsigned char byte = 0;
    if (*begin == '\n') {
      text.erase(at, 2);
    } else if (*begin == 'x' && std::from_chars(begin + 1, begin + 3, byte, 16).ptr == begin + 3) {
      text.replace(at++, 4, 1, static_cast<char>(byte));
    } else {
      return false;
    }
  }
  return true;
}

/// Reads a case without its name. Returns false if it is malformed, or two without a line between.
inline bool read_case(std::string_view written, std::string_view base, FileCase& file) {
  constexpr std::string_view kMark = "# expect: ";
  file.text = taken_line(written);
  if (!base.empty() && !add_changed(base, written, file.text)) return false;
  if (base.empty()) file.text += written;
  if (!unescape(file.text) || file.text.compare(0, kMark.size(), kMark) != 0) return false;
  file.expected = std::string_view(file.text).substr(0, file.text.find('\n')).substr(kMark.size());
  if (file.text.find(kMark, kMark.size()) != std::string::npos) return false;
  std::FILE* const to = std::fopen(file.path.data(), "wb");
  if (to == nullptr) return false;
  const bool whole = std::fwrite(file.text.data(), 1, file.text.size(), to) == file.text.size();
  return std::fclose(to) == 0 && whole;
}

/// Reads a file and puts a line break before it. Returns false if it does not end with one.
inline bool read_table(const char* path, std::string& table) {
  std::FILE* const from = std::fopen(path, "rb");
  if (from == nullptr) return false;
  std::array<char, 4096> bytes{};
  table = "\n";
  while (const std::size_t size = std::fread(bytes.data(), 1, bytes.size(), from))
    table.append(bytes.data(), size);
  std::fclose(from);
  return table.back() == '\n';
}

/// Passes every case of `table` to `judge`. Returns their number, or -1 if one is not as expected.
template <class Judge>
int judge_table(std::string_view table, FileCase& file, Judge& judge) {
  constexpr std::string_view kBegin = "\n=== ";
  std::string_view base;
  int count = 0, wrong = 0;
  for (std::size_t at = table.find(kBegin), next = 0; at != std::string_view::npos; at = next) {
    next = table.find(kBegin, at + 1);
    std::string_view written = table.substr(at + kBegin.size(), next - at - kBegin.size() + 1);
    file.name = taken_line(written);
    file.name.pop_back();
    if (file.name == "base") {
      base = written;
      continue;
    }
    ++count;
    if (read_case(written, base, file) && judge(file)) continue;
    std::fprintf(stderr, "%s: %s: not as expected\n", file.table.c_str(), file.name.c_str());
    ++wrong;
  }
  return wrong == 0 ? count : -1;
}

/// Passes every case of the tables in `folder` to `judge`, which returns whether it is as expected.
/// Returns their number, or -1 if one is not, a table has none, or none can be read.
template <class Judge>
int judge_cases(const char* folder, Judge judge) {
  static FileCase file;
  static std::string table;
  std::snprintf(file.path.data(), file.path.size(), "/tmp/tactus-case-%d", int{getpid()});
  DIR* const entries = opendir(folder);
  if (entries == nullptr) return -1;
  int count = 0, wrong = 0;
  while (const dirent* const entry = readdir(entries)) {
    if (entry->d_name[0] == '.') continue;
    file.table = std::string(folder) + "/" + entry->d_name;
    const bool read = read_table(file.table.c_str(), table);
    const int judged = read ? judge_table(table, file, judge) : 0;
    if (judged == 0) std::fprintf(stderr, "%s: has no case\n", file.table.c_str());
    count += judged;
    wrong += judged <= 0;
  }
  closedir(entries);
  std::remove(file.path.data());
  return wrong == 0 ? count : -1;
}

}  // namespace tactus
