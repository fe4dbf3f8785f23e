// ParameterReader: the SectionReader of a section while the pipeline runs. It reads what may change
// then, by the same functions and limits as from a file, and refuses everything else by its name.
#pragma once

#include "kernel/load/section_reader.hpp"

namespace tactus {

class ParameterReader : public SectionReader {
 public:
  /// `tunes`: what is described is a copy of a block, whose tunable parameters may be read; they
  /// are fixed elsewhere.
  ParameterReader(const Ini& ini, const IniSection& section, PortTable& ports, LoadError& error,
                  bool tunes)
      : SectionReader(ini, section, ports, error), tunes_(tunes) {}

  template <class Value>
  void tunable(const char* key, Value& value, const Range& range, const char* unit) {
    if (tunes_)
      SectionReader::param(key, value, range, unit);
    else
      fixed(key);
  }
  template <class Value>
  void param(const char* key, Value& /*value*/, const Range& /*range*/, const char* /*unit*/) {
    fixed(key);
  }
  template <class Value>
  void optional(const char* key, Value& /*value*/, const Range& /*range*/, const char* /*unit*/) {
    fixed(key);
  }
  void limit(const char* key, JointVector& /*value*/, const char* /*unit*/) { fixed(key); }
  template <std::size_t N>
  void text(const char* key, Text<N>& /*value*/, const char* /*meaning*/) {
    fixed(key);
  }
  template <class List>
  void lines(const char* key, List& /*list*/, const char* /*meaning*/) {
    fixed(key);
  }
  template <class Enum>
  void choice(const char* key, Enum& /*value*/) {
    fixed(key);
  }
  template <Quantity Q>
  void in(const char* key, In<Q>& /*port*/) {
    fixed(key);
  }
  template <Quantity Q>
  void optional(const char* key, In<Q>& /*port*/) {
    fixed(key);
  }
  template <Quantity Q>
  void out(const char* /*port*/, Out<Q>& /*out*/) {}
  template <class Space>
  void channel(ReferenceChannel<Space>*& /*channel*/) {}

  /// Refuses a key that is fixed when the pipeline starts.
  void fixed(const char* key) {
    if (find(key) != nullptr)
      refuse(Status::kNotOffered, key,
             "it cannot change while the pipeline runs; edit the pipeline file and start again");
  }

 private:
  bool tunes_;
};

}  // namespace tactus
