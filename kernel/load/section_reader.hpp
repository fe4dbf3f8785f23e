// SectionReader: the visitor that fills one block, or one section of settings, from the text of its
// section and binds its inputs to the outputs above it. It keeps the first mistake as the error and
// then stops reading.
//
// A key that no section reads, a typing mistake, is refused before anything else in its section,
// and so is one that is given twice, unless it is one of lines(). For that the same visitor passes
// the names once for every key, to find it among them:
//
//   while (reader.next()) settings.describe(reader);
#pragma once

#include <string_view>

#include "kernel/core/names.hpp"
#include "kernel/core/port.hpp"
#include "kernel/load/ini.hpp"
#include "kernel/pipeline/channels.hpp"
#include "kernel/pipeline/port_table.hpp"

namespace tactus {

class SectionReader {
 public:
  SectionReader(const Ini& ini, const IniSection& section, PortTable& ports, LoadError& error)
      : ini_(ini), section_(section), ports_(ports), error_(error) {}

  /// Begins to seek the first key of the section, then the next, then to read them all. False when
  /// that is done, or a key is not found among the names. [init]
  bool next();
  /// True while the names are only compared with a key.
  bool seeks() const { return seeks_; }
  /// Compares a name with the key sought. [init]
  void know(const char* key) {
    found_ = found_ || sought_ == key;
    names_ << (names_.empty() ? "" : ", ") << key;
  }

  void param(const char* key, double& value, const Range& range, const char* unit);
  void param(const char* key, int& value, const Range& range, const char* unit);
  void param(const char* key, JointVector& value, const Range& range, const char* unit);
  void param(const char* key, Vector3& value, const Range& range, const char* unit);
  /// Reads a setting that may also change while the pipeline runs.
  template <class Value>
  void tunable(const char* key, Value& value, const Range& range, const char* unit) {
    param(key, value, range, unit);
  }
  /// Reads a setting that may be left out, and keeps its initial NaN then.
  template <class Value>
  void optional(const char* key, Value& value, const Range& range, const char* unit) {
    if (find(key) != nullptr) param(key, value, range, unit);
  }
  /// Reads a limit per joint, which may be tightened from its present value, not widened.
  void limit(const char* key, JointVector& value, const char* unit);
  template <std::size_t N>
  void text(const char* key, Text<N>& value, const char* /*meaning*/) {
    const IniEntry* entry = find(key);
    if (entry == nullptr) return;
    if (entry->value.size() > N) return refuse_length(key, entry->value.size(), N);
    value = Text<N>(entry->value);
  }
  /// Reads a key that may be given any number of times, each time a line of a list, which judges it
  /// in Status add(std::string_view text, int line, Message& why); the list needs kLeast of them.
  template <class List>
  void lines(const char* key, List& list, const char* /*meaning*/) {
    if (seeks_) {
      repeats_ = repeats_ || sought_ == key;
      return know(key);
    }
    for (int i = section_.first; i < section_.first + section_.count && !failed(); ++i) {
      const IniEntry& entry = ini_.entry(i);
      if (entry.key != key) continue;
      Message why;
      const Status status = list.add(entry.value, entry.line, why);
      if (status != Status::kOk)
        static_cast<void>(error_.refuse(status, entry.line, section_.name, key, why));
    }
    if (!failed() && list.count() < List::kLeast) refuse_missing(key, "1");
  }
  template <class Enum>
  void choice(const char* key, Enum& value) {
    const int chosen = choose(key, kNames<Enum>.data(), kNames<Enum>.size());
    if (chosen >= 0) value = static_cast<Enum>(chosen);
  }

  template <Quantity Q>
  void in(const char* key, In<Q>& port) {
    bind(key, port, true);
  }
  template <Quantity Q>
  void optional(const char* key, In<Q>& port) {
    bind(key, port, false);
  }
  template <Quantity Q>
  void out(const char* port, Out<Q>& out) {
    add_output({Name(section_.name), port, Q, &out.value});
  }
  /// Gives the board's channel of a space to the first generator that requests it.
  void channel(ReferenceChannel<JointSpace>*& channel) { take(channel, &Channels::joint); }
  void channel(ReferenceChannel<TaskSpace>*& channel) { take(channel, &Channels::task); }
  /// Sets the channels that are left to take; they must outlive the reader.
  void offer(Channels& channels) { offered_ = &channels; }

  /// Returns the value of the output above that `key` names, of the given quantity; null on refusal
  /// or absence.
  const void* source(const char* key, Quantity quantity, bool required);
  bool failed() const { return error_.status != Status::kOk; }

 protected:
  /// Returns the entry of a key, or null; while it seeks, compares the name and returns null.
  const IniEntry* find(const char* key);
  void refuse(Status status, const char* key, std::string_view reason);

 private:
  template <Quantity Q>
  void bind(const char* key, In<Q>& port, bool required) {
    if (const void* value = source(key, Q, required))
      port.source = static_cast<const ValueOf<Q>*>(value);
  }
  template <class Space>
  void take(ReferenceChannel<Space>*& channel, ReferenceChannel<Space>* Channels::*which) {
    if (seeks_) return;
    channel = offered_ != nullptr ? offered_->*which : nullptr;
    if (channel == nullptr)
      return refuse(Status::kTooLarge, "type", "the board has no channel left for this generator");
    offered_->*which = nullptr;
  }
  /// Refuses a key that no name was, or that was given before.
  bool judge_sought(const IniEntry& entry);
  void add_output(const PortEntry& entry);
  int choose(const char* key, const char* const* words, std::size_t count);
  /// Reads as many numbers as there are values, or for joints also one number for all. Without the
  /// key the defaults remain, if there are any.
  bool numbers(const char* key, double* values, int count, bool joints, const char* unit);
  /// Returns the word in the file that gave value `index`.
  std::string_view written(const char* key, int index);
  /// Refuses number `index`, `of` "joint " or of nothing in particular. One that the file does not
  /// give is a default that its block may not have.
  void refuse_value(const char* key, const char* of, int index, double value, const Range& range,
                    const char* unit);
  void refuse_length(const char* key, std::size_t length, std::size_t limit);
  void refuse_missing(const char* key, const char* unit);

  const Ini& ini_;
  const IniSection& section_;
  PortTable& ports_;
  LoadError& error_;
  Channels* offered_ = nullptr;
  int checked_ = -1;         // keys that next() has sought; -1: it was not called
  std::string_view sought_;  // the key, while seeks_
  Message names_;            // those it was compared with
  bool seeks_ = false, found_ = false;
  bool repeats_ = false;  // the key sought may be given several times
};

}  // namespace tactus
