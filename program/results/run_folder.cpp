#include "program/results/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "program/results/result_file.hpp"

namespace tactus {
namespace {

constexpr const char* kEarlier = "earlier_run";
constexpr const char *kSummary = "summary.json", *kIncomplete = "incomplete.txt",
                     *kRefusedRun = "refused.txt", *kPipeline = "pipeline.ini";

/// The files that a run can leave. The summary is the first to be moved or removed: without it
/// nothing is taken for a run that has ended.
constexpr const char* kResults[] = {
    kSummary,  "summary.json.part", kPipeline,    "scene.json", "waypoints.csv",
    "log.csv", "figure.png",        "figure.pdf", kIncomplete,  kRefusedRun};

bool complain(const FilePath& path) {
  std::fprintf(stderr, "%s: %s; choose another --out\n", path.c_str(), std::strerror(errno));
  return false;
}

bool exists(const FilePath& path) {
  return access(path.c_str(), F_OK) == 0;
}

/// False: there is one, and it cannot be removed.
bool removed(const FilePath& path) {
  return unlink(path.c_str()) == 0 || errno == ENOENT || complain(path);
}

bool same_file(const char* path, const FilePath& other) {
  struct stat a, b;
  return path != nullptr && stat(path, &a) == 0 && stat(other.c_str(), &b) == 0 &&
         a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool remove_results(std::string_view folder) {
  for (const char* name : kResults)
    if (!removed(in_folder(folder, name))) return false;
  return true;
}

Text<63> now() {
  const std::time_t seconds = std::time(nullptr);
  std::tm local{};
  char text[64] = "";
  if (localtime_r(&seconds, &local) != nullptr)
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &local);
  return Text<63>(text);
}

bool write_text(const FilePath& path, std::string_view text) {
  ResultFile file;
  if (!file.open(path.c_str())) return false;
  std::fwrite(text.data(), 1, text.size(), file.stream());
  return file.close();
}

}  // namespace

FilePath in_folder(std::string_view folder, const char* file) {
  FilePath path = folder;
  path << "/" << file;
  return path;
}

RunFolder::RunFolder(const Options& options) : path_(options.out) {
  if (path_.empty()) path_ << "out/" << stem(options.pipeline);
}

/// Keeps other runs out of the folder until this program ends; kFailed: errno is the reason.
RunFolder::Lock RunFolder::lock() {
  const int file = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0) return Lock::kTaken;
  const int reason = errno;
  if (file >= 0) close(file);
  errno = reason;
  return reason == EWOULDBLOCK ? Lock::kOther : Lock::kFailed;
}

/// Moves the files of a run that has ended to earlier_run/, in the place of those of one before it;
/// removes those of a run that has not. The inputs of the run that begins stay where they are.
bool RunFolder::set_aside(const RunInputs& inputs) {
  const FilePath earlier = file(kEarlier);
  const bool ended = exists(file(kSummary));
  if (ended && mkdir(earlier.c_str(), 0777) != 0 && errno != EEXIST) return complain(earlier);
  if (ended && !remove_results(earlier)) return false;
  for (const char* name : kResults) {
    const FilePath path = file(name);
    if (same_file(inputs.pipeline, path) || same_file(inputs.trajectory, path)) continue;
    if (!ended) {
      if (!removed(path)) return false;
    } else if (rename(path.c_str(), in_folder(earlier, name).c_str()) != 0 && errno != ENOENT) {
      return complain(path);
    }
  }
  return true;
}

bool RunFolder::mark(const char* marker, const char* what, std::string_view pipeline) {
  Text<2047> text("The run of ");
  text << pipeline << " of " << now() << " " << what << "\n";
  if (exists(in_folder(file(kEarlier), kSummary)))
    text << "The last run that has ended here is in " << kEarlier << "/.\n";
  return write_text(file(marker), text);
}

/// False: the run would replace a file that it reads, or that no run has written; prints which.
bool RunFolder::keeps(const RunInputs& inputs) const {
  const FilePath earlier = file(kEarlier);
  bool runs = exists(in_folder(earlier, kSummary));
  for (const char* name : {kSummary, kIncomplete, kRefusedRun}) runs = runs || exists(file(name));
  for (const char* name : kResults) {
    const FilePath path = file(name), old = in_folder(earlier, name);
    const bool copied = std::strcmp(name, kPipeline) == 0 && same_file(inputs.pipeline, path);
    const bool read = same_file(inputs.trajectory, path) || same_file(inputs.trajectory, old) ||
                      same_file(inputs.pipeline, path) || same_file(inputs.pipeline, old);
    if (copied || (!read && (runs || !exists(path)))) continue;
    std::fprintf(stderr, "%s: the run would replace this file, %s; choose another --out\n",
                 path.c_str(), read ? "which it reads" : "which no run has written");
    return false;
  }
  return true;
}

bool RunFolder::begin(const RunInputs& inputs, std::string_view text) {
  if (!make_folder(path_)) return false;
  const Lock locked = lock();
  if (locked == Lock::kFailed) return complain(path_);
  if (locked == Lock::kOther) {
    std::fprintf(
        stderr,
        "%s: another run writes into this folder; wait for its end, or choose another --out\n",
        path_.c_str());
    return false;
  }
  if (!keeps(inputs) || !set_aside(inputs) ||
      !mark(kIncomplete, "has not ended, or was killed.", inputs.pipeline))
    return false;
  return same_file(inputs.pipeline, file(kPipeline)) || write_text(file(kPipeline), text);
}

bool RunFolder::complete(bool of_cycles) {
  if (rename(summary_part().c_str(), file(kSummary).c_str()) != 0) return complain(file(kSummary));
  if (!removed(file(kIncomplete))) return false;
  const FilePath earlier = file(kEarlier);
  if (!of_cycles || !exists(in_folder(earlier, kSummary))) return true;
  if (!remove_results(earlier)) return false;
  rmdir(earlier.c_str());  // kept if it contains other files
  return true;
}

void RunFolder::refuse(const RunInputs& inputs) {
  if (!exists(file(kSummary)) || lock() != Lock::kTaken || !set_aside(inputs)) return;
  if (mark(kRefusedRun, "was refused before its first cycle.", inputs.pipeline))
    std::fprintf(stderr, "%s: the run before this one is now in %s\n", path_.c_str(),
                 file(kEarlier).c_str());
}

}  // namespace tactus
