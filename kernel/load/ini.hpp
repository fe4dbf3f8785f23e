// The text of a pipeline file as a fixed table of entries: sections "[name]", lines "key = value",
// comments from '#'. It checks the form of the file; the loader checks what the keys mean.
#pragma once

#include <array>
#include <string_view>

#include "kernel/core/load_error.hpp"

namespace tactus {

inline constexpr int kMaxSections = 24;
inline constexpr int kMaxEntries = 256;
inline constexpr std::size_t kMaxLineLength = 240;

struct IniEntry {
  int line = 0;
  std::string_view key, value;  ///< into the text, which must outlive the table
};

struct IniSection {
  int line = 0;
  std::string_view name;
  int first = 0, count = 0;  ///< its entries
};

class Ini {
 public:
  /// Splits `text`. If it is refused, `error` has the reason, and the table must not be used.
  /// [init]
  Status parse(std::string_view text, LoadError& error);

  /// Begins a section, and adds an entry to it. `line` is where they are, for the refusal. [init]
  Status add_section(std::string_view name, int line, LoadError& error);
  Status add_entry(std::string_view key, std::string_view value, int line, LoadError& error);

  int section_count() const { return section_count_; }
  const IniSection& section(int index) const { return sections_[static_cast<std::size_t>(index)]; }
  const IniEntry& entry(int index) const { return entries_[static_cast<std::size_t>(index)]; }
  /// Returns the section of that name, or null. [init]
  const IniSection* find(std::string_view name) const;
  /// Returns the first entry of that key in a section, or null; a later one is the reader's to
  /// judge. [init]
  const IniEntry* find(const IniSection& section, std::string_view key) const;

 private:
  Status parse_line(std::string_view line, int number, LoadError& error);

  std::array<IniSection, kMaxSections> sections_;
  std::array<IniEntry, kMaxEntries> entries_;
  int section_count_ = 0, entry_count_ = 0;
};

/// False if the line contains a control character; UTF-8 is allowed. [any]
bool is_text(std::string_view line);
/// The message about a line that contains one.
inline constexpr const char* kNotText =
    "the line contains bytes that are not text; save the file as UTF-8, its line ends those of "
    "Linux or Windows";

/// Returns the text without the byte order mark with which some editors begin a file. [any]
std::string_view without_byte_order_mark(std::string_view text);

/// Returns the text without blanks at either end. [any]
std::string_view trim(std::string_view text);

/// Takes the first word off `text`; empty if there is none left. [any]
std::string_view take_word(std::string_view& text);

/// Takes the text before the next comma off a list; `more` is true if there was a comma. [init]
std::string_view take_item(std::string_view& list, bool& more);

}  // namespace tactus
