#include "kernel/load/ini.hpp"

namespace tactus {
namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool is_name(std::string_view text) {
  if (text.empty() || text.size() > kMaxNameLength) return false;
  for (const char c : text) {
    if (!is_name_character(c)) return false;
  }
  return true;
}

std::string_view prefix(std::string_view text, std::size_t size) {
  text.remove_suffix(text.size() - size);
  return text;
}

/// Takes the first line off `text`; returns it without its line end.
std::string_view take_line(std::string_view& text) {
  std::size_t size = 0;
  while (size < text.size() && text[size] != '\n') ++size;
  std::string_view line = prefix(text, size);
  text.remove_prefix(size < text.size() ? size + 1 : size);
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return line;
}

std::string_view without_comment(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '#') return prefix(line, i);
  }
  return line;
}

}  // namespace

bool is_text(std::string_view line) {
  for (const char c : line) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\t') || byte == 0x7f) return false;
  }
  return true;
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.size() >= kMark.size() && prefix(text, kMark.size()) == kMark)
    text.remove_prefix(kMark.size());
  return text;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view take_word(std::string_view& text) {
  text = trim(text);
  std::size_t size = 0;
  while (size < text.size() && !is_blank(text[size])) ++size;
  const std::string_view word = prefix(text, size);
  text.remove_prefix(size);
  return word;
}

std::string_view take_item(std::string_view& list, bool& more) {
  std::size_t size = 0;
  while (size < list.size() && list[size] != ',') ++size;
  const std::string_view item(list.data(), size);
  more = size < list.size();
  list.remove_prefix(more ? size + 1 : size);
  return item;
}

const IniSection* Ini::find(std::string_view name) const {
  for (int i = 0; i < section_count_; ++i) {
    if (section(i).name == name) return &section(i);
  }
  return nullptr;
}

const IniEntry* Ini::find(const IniSection& section, std::string_view key) const {
  for (int i = section.first; i < section.first + section.count; ++i) {
    if (entry(i).key == key) return &entry(i);
  }
  return nullptr;
}

Status Ini::parse(std::string_view text, LoadError& error) {
  section_count_ = entry_count_ = 0;
  int number = 0;
  text = without_byte_order_mark(text);
  while (!text.empty()) {
    TRY(parse_line(take_line(text), ++number, error));
  }
  if (section_count_ == 0) {
    return error.refuse(Status::kBadSyntax, 0, {}, {}, "the file is empty: it has no section");
  }
  return Status::kOk;
}

Status Ini::parse_line(std::string_view line, int number, LoadError& error) {
  if (line.size() > kMaxLineLength) {
    Message reason("the line has ");
    reason << line.size() << " characters; the limit is " << kMaxLineLength;
    return error.refuse(Status::kTooLarge, number, {}, {}, reason);
  }
  if (!is_text(line)) {
    return error.refuse(Status::kBadSyntax, number, {}, {}, kNotText);
  }
  line = trim(without_comment(line));
  if (line.empty()) return Status::kOk;
  if (line.front() == '[') {
    if (line.back() != ']') {
      return error.refuse(Status::kBadSyntax, number, {}, {},
                          "a section header is [name], with nothing after it");
    }
    line.remove_prefix(1);
    line.remove_suffix(1);
    return add_section(trim(line), number, error);
  }
  std::size_t equals = 0;
  while (equals < line.size() && line[equals] != '=') ++equals;
  if (equals == line.size()) {
    return error.refuse(Status::kBadSyntax, number, {}, {}, "expected [section] or key = value");
  }
  std::string_view value = line;
  value.remove_prefix(equals + 1);
  return add_entry(trim(prefix(line, equals)), trim(value), number, error);
}

Status Ini::add_section(std::string_view name, int line, LoadError& error) {
  if (!is_name(name)) {
    return error.refuse(Status::kBadSyntax, line, {}, {},
                        "a section name is 1 to 31 letters, digits or underscores");
  }
  if (const IniSection* earlier = find(name)) {
    Message reason("the section is already given at line ");
    reason << earlier->line;
    return error.refuse(Status::kDuplicate, line, name, {}, reason);
  }
  if (section_count_ == kMaxSections) {
    return error.refuse(Status::kTooLarge, line, name, {},
                        Message("more than ") << kMaxSections << " sections");
  }
  IniSection& section = sections_[static_cast<std::size_t>(section_count_++)];
  section = {line, name, entry_count_, 0};
  return Status::kOk;
}

Status Ini::add_entry(std::string_view key, std::string_view value, int line, LoadError& error) {
  if (section_count_ == 0) {
    return error.refuse(Status::kBadSyntax, line, {}, {},
                        "key = value is before the first [section]");
  }
  IniSection& section = sections_[static_cast<std::size_t>(section_count_ - 1)];
  Status status = Status::kOk;
  Message reason;
  if (!is_name(key)) {
    status = Status::kBadSyntax;
    reason << "a key is 1 to 31 letters, digits or underscores";
  } else if (value.empty()) {
    status = Status::kBadValue;
    reason << "the value is missing";
  } else if (value.size() > kMaxValueLength) {
    status = Status::kTooLarge;
    reason << "the value has " << value.size() << " characters; the limit is " << kMaxValueLength;
  } else if (entry_count_ == kMaxEntries) {
    status = Status::kTooLarge;
    reason << "more than " << kMaxEntries << " keys";
  }
  if (status != Status::kOk) {
    return error.refuse(status, line, section.name, is_name(key) ? key : "", reason);
  }
  entries_[static_cast<std::size_t>(entry_count_++)] = {line, key, value};
  ++section.count;
  return Status::kOk;
}

}  // namespace tactus
