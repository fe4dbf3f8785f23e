// Files of a run: reads the pipeline text, resolves paths, makes the output folder.
#pragma once

#include <string_view>

#include "kernel/load/loader.hpp"
#include "program/session/options.hpp"

namespace tactus {

using FilePath = Text<1023>;  ///< fits two joined paths: each one given is shorter than 512

/// Reads the pipeline file at `path`, writes the overrides into its text, loads it and keeps it in
/// `text`. False: refused; prints "path:line: [section] key: reason" to stderr, with the option in
/// the place of path and line if that has caused it.
bool load_pipeline(const char* path, Loader& loader, Pipeline& pipeline, std::string_view& text,
                   const OverrideOptions& options = {});

/// Returns `path` as seen from the folder of the file `from`; an absolute path is unchanged.
FilePath relative_to(std::string_view from, std::string_view path);

/// Returns the last part of a path without its extension.
std::string_view stem(std::string_view path);

/// Makes the folder and its parents. False: prints the reason to stderr.
bool make_folder(std::string_view path);

}  // namespace tactus
