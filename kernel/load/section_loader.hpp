// SectionLoader: visits a list of sections, the pipeline's or a board's, reads the one that the
// file has here and collects the names of all.
#pragma once

#include <cassert>

#include "kernel/load/section_reader.hpp"

namespace tactus {

/// Refuses a key that nobody reads, a typing mistake, before anything else in its section.
/// `describe` is called with a visitor of the names. [init]
template <class Describe>
Status refuse_unknown_keys(const Ini& ini, const IniSection& section, LoadError& error,
                           Describe describe) {
  for (int i = section.first; i < section.first + section.count; ++i) {
    const IniEntry& entry = ini.entry(i);
    KeyFinder finder(entry.key);
    describe(finder);
    if (!finder.found())
      return error.refuse(Status::kUnknownKey, entry.line, section.name, entry.key,
                          "the section has no such key");
  }
  return Status::kOk;
}

class SectionLoader {
 public:
  SectionLoader(const Ini& ini, const IniSection& section, PortTable& ports, LoadError& error)
      : ini_(ini), section_(section), ports_(ports), error_(error) {}

  template <class Settings>
  void section(const char* name, Settings& settings) {
    read(name, settings, [&](SectionReader& reader) { settings.describe(reader); });
  }

  /// Returns true if the section was in the lists; a fault in it is in the error.
  bool found() const { return found_; }
  /// "robot, guard, ...": the sections of all lists.
  const Message& names() const { return names_; }

 protected:
  /// Returns true if the section of the file is this one and has no fault.
  template <class Settings, class Read>
  bool read(const char* name, Settings& settings, Read into) {
    names_ << (names_.empty() ? "" : ", ") << name;
    if (section_.name != name) return false;
    assert(!found_ && "two sections have the same name");
    found_ = true;
    if (refuse_unknown_keys(ini_, section_, error_,
                            [&](KeyFinder& finder) { settings.describe(finder); }) != Status::kOk)
      return false;
    SectionReader reader(ini_, section_, ports_, error_);
    into(reader);
    return !reader.failed();
  }

  const Ini& ini_;
  const IniSection& section_;
  PortTable& ports_;
  LoadError& error_;

 private:
  Message names_;
  bool found_ = false;
};

}  // namespace tactus
