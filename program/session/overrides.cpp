#include "program/session/overrides.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "kernel/load/ini.hpp"

namespace tactus {
namespace {

/// Puts `with` in the place of `length` bytes; false if it does not fit.
bool replace(PipelineText& text, std::size_t at, std::size_t length, std::string_view with) {
  const std::size_t size = text.size - length + with.size();
  if (size > kMaxPipelineBytes) return false;
  char* const to = text.bytes.data() + at;
  std::memmove(to + with.size(), to + length, text.size - at - length);
  std::memcpy(to, with.data(), with.size());
  text.size = size;
  return true;
}

int lines_of(std::string_view text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

/// What gives a key its value: `with` in the place of `length` bytes.
struct Edit {
  std::size_t at, length;
  Text<2 * sizeof OverrideOptions::texts[0]> with;
};

Edit edit_of(const char* option, const Ini& ini, std::string_view text) {
  const std::string_view all(option), left = all.substr(0, all.find('='));
  const std::string_view name = trim(left.substr(0, left.find('.')));
  const std::string_view key = trim(left.substr(left.find('.') + 1));
  const std::string_view value = trim(all.substr(left.size() + 1));
  const auto offset = [text](std::string_view part) {
    return static_cast<std::size_t>(part.data() - text.data());
  };
  const IniSection* section = ini.find(name);
  const IniEntry* entry = section != nullptr ? ini.find(*section, key) : nullptr;
  Edit edit{text.size(), 0, {}};
  if (entry != nullptr) {
    edit.at = offset(entry->value);
    edit.length = entry->value.size();
    edit.with << value;
    return edit;
  }
  if (section != nullptr)
    edit.at = std::min(text.size(), text.find('\n', offset(section->name)));
  else
    edit.with << "\n[" << name << "]";
  edit.with << "\n" << key << " = " << value;
  return edit;
}

}  // namespace

bool Overrides::write(const OverrideOptions& options, PipelineText& text) {
  for (int i = 0; i < options.count; ++i) {
    Ini ini;
    LoadError error;
    if (ini.parse(text.view(), error) != Status::kOk) return true;
    const Edit edit = edit_of(options.texts[i], ini, text.view());
    if (!replace(text, edit.at, edit.length, edit.with)) {
      std::fprintf(stderr, "--set %s: the file would be larger than %zu bytes\n", options.texts[i],
                   kMaxPipelineBytes);
      return false;
    }
    note(options.texts[i], 1 + lines_of(text.view().substr(0, edit.at)), lines_of(edit.with));
  }
  return true;
}

void Overrides::note(const char* option, int line, int added) {
  const int first = line + std::min(1, added);
  for (int i = 0; i < count_; ++i) {
    Written& earlier = written_[static_cast<std::size_t>(i)];
    if (earlier.first >= first) earlier.first += added;
  }
  written_[static_cast<std::size_t>(count_++)] = {option, first, added};
}

const char* Overrides::place(LoadError& error) const {
  int before = 0;
  for (int i = count_ - 1; i >= 0; --i) {
    const Written& one = written_[static_cast<std::size_t>(i)];
    if (error.line >= one.first && error.line < one.first + std::max(1, one.added)) {
      error.line = 0;
      return one.option;
    }
    before += one.first < error.line ? one.added : 0;
  }
  error.line -= before;
  return nullptr;
}

}  // namespace tactus
