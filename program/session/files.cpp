#include "program/session/files.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "program/session/overrides.hpp"

namespace tactus {
namespace {

PipelineText pipeline_text;

bool read_text(const char* path, PipelineText& text) {
  std::FILE* file = std::fopen(path, "rb");
  if (file == nullptr) {
    std::fprintf(stderr, "%s: %s; give the path of a pipeline file\n", path, std::strerror(errno));
    return false;
  }
  text.size = std::fread(text.bytes.data(), 1, text.bytes.size(), file);
  const int failure = std::ferror(file) != 0 ? errno : 0;
  std::fclose(file);
  if (failure != 0) {
    std::fprintf(stderr, "%s: %s; give the path of a pipeline file\n", path,
                 std::strerror(failure));
    return false;
  }
  if (text.size > kMaxPipelineBytes) {
    std::fprintf(stderr, "%s: the file is larger than %zu bytes\n", path, kMaxPipelineBytes);
    return false;
  }
  return true;
}

}  // namespace

bool load_pipeline(const char* path, Loader& loader, Pipeline& pipeline, std::string_view& text,
                   const OverrideOptions& options) {
  Overrides overrides;
  if (!read_text(path, pipeline_text) || !overrides.write(options, pipeline_text)) return false;
  text = pipeline_text.view();
  LoadError error;
  if (loader.load(text, pipeline, error) == Status::kOk) return true;
  if (const char* option = overrides.place(error))
    std::fprintf(stderr, "--set %s: %s\n", option, error.message().c_str());
  else
    std::fprintf(stderr, "%s:%s%s\n", path, error.line > 0 ? "" : " ", error.message().c_str());
  return false;
}

FilePath relative_to(std::string_view from, std::string_view path) {
  const std::size_t slash = from.rfind('/');
  if (path.substr(0, 1) == "/" || slash == std::string_view::npos) return path;
  FilePath joined(from.substr(0, slash + 1));
  joined << path;
  return joined;
}

std::string_view stem(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
  return path.substr(0, path.rfind('.'));
}

bool make_folder(std::string_view path) {
  for (std::size_t end = 1; end <= path.size(); ++end) {
    if (end < path.size() && path[end] != '/') continue;
    const FilePath part(path.substr(0, end));
    if (mkdir(part.c_str(), 0777) != 0 && errno != EEXIST) {
      std::fprintf(stderr, "%s: %s; choose another --out\n", part.c_str(), std::strerror(errno));
      return false;
    }
  }
  return true;
}

}  // namespace tactus
