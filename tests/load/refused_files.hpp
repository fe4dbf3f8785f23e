// Reads the files of tests/refused, each with one mistake. Its first line, "# expect: ...", is the
// refusal after the file's name; "..." at its end stands for the rest of a list. Tests run from the
// root of the project.
#pragma once

#include <dirent.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace tactus {

struct RefusedFile {
  std::array<char, 320> path{};
  std::array<char, 16384> bytes{};
  std::string_view text, expected;

  bool read() {
    std::FILE* file = std::fopen(path.data(), "rb");
    if (file == nullptr) return false;
    text = {bytes.data(), std::fread(bytes.data(), 1, bytes.size(), file)};
    std::fclose(file);
    constexpr std::string_view kMark = "# expect: ";
    expected = text.substr(0, text.find('\n'));
    if (text.size() == bytes.size() || expected.substr(0, kMark.size()) != kMark) return false;
    expected.remove_prefix(kMark.size());
    return true;
  }
  /// Whether `message` is as expected; prints both if not.
  bool expects(std::string_view message) const {
    constexpr std::string_view kRest = "...";
    const std::size_t begin = expected.rfind(kRest);
    const bool listed = begin != std::string_view::npos && begin + kRest.size() == expected.size();
    if (listed ? message.substr(0, begin) == expected.substr(0, begin) : message == expected)
      return true;
    std::fprintf(stderr, "%s\n  expected %.*s\n  got      %.*s\n", path.data(),
                 static_cast<int>(expected.size()), expected.data(),
                 static_cast<int>(message.size()), message.data());
    return false;
  }
};

/// Passes every file of `folder` with that ending to `judge`, which returns whether it was refused
/// as expected. Returns their number, or -1 if one of them was not refused so or cannot be read.
template <class Judge>
int judge_refused_files(const char* folder, std::string_view ending, Judge judge) {
  static RefusedFile file;
  DIR* entries = opendir(folder);
  if (entries == nullptr) return -1;
  int count = 0, wrong = 0;
  for (const dirent* entry = readdir(entries); entry != nullptr; entry = readdir(entries)) {
    const std::string_view name = entry->d_name;
    if (name.size() < ending.size() || name.substr(name.size() - ending.size()) != ending) continue;
    std::snprintf(file.path.data(), file.path.size(), "%s/%s", folder, entry->d_name);
    ++count;
    if (!file.read() || !judge(file)) ++wrong;
  }
  closedir(entries);
  return wrong == 0 ? count : -1;
}

}  // namespace tactus
