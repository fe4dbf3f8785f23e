#include "sim_plant/ur/server/scene_file.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "sim_plant/ur/scene/scene_reader.hpp"

namespace tactus::ur {

bool read_scene_file(const char* path, Surroundings& around) {
  static std::array<char, 65536 + 1> text;
  static SceneReader reader;
  std::FILE* file = std::fopen(path, "rb");
  const std::size_t size = file != nullptr ? std::fread(text.data(), 1, text.size(), file) : 0;
  const bool failed = file == nullptr || std::ferror(file) != 0;
  const int why = errno;
  if (file != nullptr) std::fclose(file);
  if (failed) {
    std::fprintf(stderr, "%s: %s\n", path, std::strerror(why));
    return false;
  }
  if (size == text.size()) {
    std::fprintf(stderr, "%s: the file is larger than %zu bytes\n", path, text.size() - 1);
    return false;
  }
  LoadError error;
  if (reader.read({text.data(), size}, around, error) == Status::kOk) return true;
  std::fprintf(stderr, "%s:%s%s\n", path, error.line > 0 ? "" : " ", error.message().c_str());
  return false;
}

}  // namespace tactus::ur
