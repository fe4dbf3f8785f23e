// The folder of a run. Its files are those of one run, whatever ends it. The files of the run
// before it are set aside in earlier_run/ before the first of its own is written, and removed once
// summary.json is in place, which is written last, under another name, and only if all others could
// be. Until then incomplete.txt explains the folder. Other files of the folder are left alone.
// See docs/decisions/0019-a-folder-of-one-run.md.
#pragma once

#include <string_view>

#include "program/session/files.hpp"
#include "program/session/options.hpp"

namespace tactus {

/// Returns "folder/file".
FilePath in_folder(std::string_view folder, const char* file);

/// The files that a run reads; null: none. A folder does not set them aside.
struct RunInputs {
  const char *pipeline, *trajectory;
};

class RunFolder {
 public:
  /// The folder of the command line, out/<pipeline> without one.
  explicit RunFolder(const Options& options);

  const FilePath& path() const { return path_; }
  FilePath file(const char* name) const { return in_folder(path_, name); }

  /// Makes the folder, locks it until the program ends, sets an earlier run aside, and writes
  /// `text`, that of the pipeline file, to pipeline.ini. False: prints the reason to stderr.
  bool begin(const RunInputs& inputs, std::string_view text);
  /// Makes the run complete once the summary has been written to `summary_part`. A run `of_cycles`
  /// replaces the one set aside. False: prints the reason to stderr.
  bool complete(bool of_cycles);
  /// For a run that was refused before begin(): if an earlier one has ended in the folder, sets it
  /// aside, so that it is not mistaken for this one, and says so. A folder in which another run
  /// writes, or that is not there, is left alone.
  void refuse(const RunInputs& inputs);

  FilePath summary_part() const { return file("summary.json.part"); }

 private:
  enum class Lock { kTaken, kOther, kFailed };
  Lock lock();
  bool keeps(const RunInputs& inputs) const;
  bool set_aside(const RunInputs& inputs);
  bool mark(const char* marker, const char* what, std::string_view pipeline);

  FilePath path_;
};

}  // namespace tactus
