// SectionLoader: visits a list of sections, the pipeline's or a board's, reads the one that the
// file has here and collects the names of all.
#pragma once

#include "kernel/load/section_reader.hpp"

namespace tactus {

class SectionLoader {
 public:
  SectionLoader(const Ini& ini, const IniSection& section, PortTable& ports, LoadError& error)
      : ini_(ini), section_(section), ports_(ports), error_(error) {}

  template <class Settings>
  void section(const char* name, Settings& settings) {
    read(name, [&](SectionReader& reader) { settings.describe(reader); });
  }

  /// Returns true if the section was in the lists; a fault in it is in the error.
  bool found() const { return found_; }
  /// "robot, guard, ...": the sections of all lists.
  const Message& names() const { return names_; }

 protected:
  /// Returns true if the section of the file is this one and has no fault.
  template <class Describe>
  bool read(const char* name, Describe describe) {
    if (!begins(name)) return false;
    SectionReader reader(ini_, section_, ports_, error_);
    while (reader.next()) describe(reader);
    return !reader.failed();
  }

  const Ini& ini_;
  const IniSection& section_;
  PortTable& ports_;
  LoadError& error_;

 private:
  /// Notes a section of the lists; true if the section of the file is this one.
  bool begins(const char* name);

  Message names_;
  bool found_ = false;
};

}  // namespace tactus
