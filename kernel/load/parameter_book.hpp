// ParameterBook: the parameters of a running pipeline, for a client that changes them outside the
// cycle. It has a copy of every block with tunable parameters, three times: as the file has it, as
// it is now, and as it will be. A set is read into the last, as a section of the file would be, and
// the cycle takes it from there:
//
//   prepare(set) ---> tuning() ---> Pipeline::retune, between two cycles ---> commit() or drop()
//
// The blocks of the pipeline are never read here once it runs, but for settings that are fixed.
#pragma once

#include <algorithm>

#include "kernel/load/ini.hpp"
#include "kernel/pipeline/with_block.hpp"

namespace tactus {

/// A parameter of a set: words as in the pipeline file, which outlive the call.
struct ParameterText {
  std::string_view section, key, value;
};

namespace detail {
/// Returns the size of the largest kind with tunable parameters.
template <class... Each>
constexpr std::size_t largest_tunable(KindList<Each...>) {
  return std::max({std::size_t{1}, (kTunes<Each> ? sizeof(Each) : 0)...});
}
}  // namespace detail

class ParameterBook {
 public:
  enum class Copy : std::uint8_t { kOfFile, kPresent, kNext };

  /// Copies the blocks of a pipeline that is loaded and does not run yet. [init]
  [[gnu::cold]] explicit ParameterBook(Pipeline& pipeline);

  /// Reads a set. Refused: `error` has section, key and reason, and nothing has changed. Otherwise
  /// tuning() is it until commit() or drop(). [init]
  Status prepare(const ParameterText* set, int count, LoadError& error);
  /// The argument of Pipeline::retune().
  const Tuning& tuning() const { return tuning_; }
  /// The cycle has taken the set. [init]
  void commit() { copy(Copy::kNext, Copy::kPresent); }
  /// Discards the new set, which the cycle has refused or was not sent. [init]
  void drop() { copy(Copy::kPresent, Copy::kNext); }

  /// Calls visit(name, block) for every section: those of the pipeline, then the blocks. [init]
  template <class Visit>
  void each_section(Copy which, Visit visit);

 private:
  struct Place {
    alignas(std::max_align_t) std::byte bytes[detail::largest_tunable(Kinds())];
  };
  using Places = std::array<Place, kMaxBlocks>;

  template <class Visit>
  struct Sections {
    Visit& visit;
    template <class Settings>
    void section(const char* name, Settings& settings) {
      visit(std::string_view(name), settings);
    }
  };

  /// The block of a copy; the pipeline's own if it has no tunable parameter.
  Block block(Copy which, int i);
  void copy(Copy from, Copy to);
  Status fill(const ParameterText* set, int count, Ini& ini, LoadError& error) const;
  Status read(const Ini& ini, const IniSection& section, LoadError& error);
  Status judge(int i, LoadError& error);
  Status refuse_unknown(std::string_view section, LoadError& error);

  Pipeline& pipeline_;
  std::array<Places, 3> copies_;
  Tuning tuning_;
};

template <class Visit>
void ParameterBook::each_section(Copy which, Visit visit) {
  Sections<Visit> sections{visit};
  pipeline_.describe(sections);
  for (int i = 0; i < pipeline_.count(); ++i)
    with_block(block(which, i),
               [&](auto& its) { visit(std::string_view(pipeline_.name(i)), its); });
}

}  // namespace tactus
