// Files of a run: reading the pipeline text, resolving paths, making the output folder.
#pragma once

#include <string_view>

#include "kernel/loader.hpp"

namespace tactus {

using FilePath = Text<1023>;  ///< room for two joined: those given are shorter than 512

inline constexpr std::size_t kMaxPipelineBytes = 65536;

/// Reads and loads the pipeline file at `path`, whose text is kept in `text`. Prints "path:line:
/// [section] key: reason" to the error stream and returns false if it is refused.
bool load_pipeline(const char* path, Loader& loader, Pipeline& pipeline, std::string_view& text);

/// `path` as seen from the folder of `from`; absolute paths stay.
FilePath relative_to(std::string_view from, std::string_view path);

/// The last part of a path without its extension.
std::string_view stem(std::string_view path);

/// Makes the folder and those above it; false with a message on the error stream.
bool make_folder(std::string_view path);

/// FNV-1a hash of a text, continued from `hash`.
std::uint64_t fnv1a(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325U);
/// The same of a whole file; `hash` unchanged if it cannot be read.
std::uint64_t fnv1a_of_file(const char* path, std::uint64_t hash);

}  // namespace tactus
