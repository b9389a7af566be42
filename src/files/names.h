#pragma once

#include <filesystem>
#include <string>

namespace mimicry {

/// Names of files are UTF-8 everywhere in this project. std::filesystem::path takes a std::string
/// for that on POSIX only: on Windows it takes it for the system's old code page.
std::filesystem::path to_path(const std::string& text);
std::string to_text(const std::filesystem::path& path);

/// The last part of a path: "a/b.obj" gives "b.obj".
std::string file_name(const std::string& path);
/// The same without its ending: "b".
std::string file_stem(const std::string& path);
/// `name` in `folder`; an absolute name, or one in no folder, as it is.
std::string join_path(const std::string& folder, const std::string& name);

}  // namespace mimicry
