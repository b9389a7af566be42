#include <string>

#include <mimicry/base/error.h>
#include <mimicry/io/meshes.h>

namespace mimicry {
namespace {

std::string_view without_folders(std::string_view name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string_view::npos ? name : name.substr(slash + 1);
}

std::optional<std::string> find_file(std::span<const NamedBytes> files, std::string_view folder,
                                     const std::string& name) {
  const NamedBytes* only = nullptr;
  std::size_t count = 0;
  for (const NamedBytes& file : files) {
    if (file.name == std::string(folder) + name) return std::string(file.bytes);
    if (without_folders(file.name) != without_folders(name)) continue;
    only = &file;
    ++count;
  }
  if (count != 1) return std::nullopt;
  return std::string(only->bytes);
}

}  // namespace

std::size_t mesh_among(std::span<const NamedBytes> files, std::string_view name) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < files.size(); ++k)
    if (name.empty() ? is_mesh_name(files[k].name) : files[k].name == name) found.push_back(k);
  if (found.size() == 1) return found[0];
  if (!name.empty())
    throw Error(ErrorKind::invalid_input,
                std::string(name) + (found.empty() ? ": is not among the files; give it with them"
                                                   : ": is given more than once"));
  if (found.empty())
    throw Error(
        ErrorKind::invalid_input,
        std::string(files.empty() ? "no file" : files[0].name) +
            ": there is no mesh among the files (.obj .ply .stl .off .glb .gltf); give one");
  throw Error(ErrorKind::invalid_input, std::string(files[found[0]].name) + " and " +
                                            std::string(files[found[1]].name) +
                                            ": both are meshes; say which one is meant");
}

TriangleMesh read_mesh_files(std::span<const NamedBytes> files, std::size_t mesh,
                             const MeshReadOptions& options) {
  const NamedBytes& file = files[mesh];
  const std::string_view folder =
      file.name.substr(0, file.name.size() - without_folders(file.name).size());
  MeshReadOptions with_files = options;
  with_files.companion = [&](const std::string& name) {
    auto bytes = find_file(files, folder, name);
    return !bytes && options.companion ? options.companion(name) : bytes;
  };
  return read_mesh(file.bytes, mesh_format_of(file.name), file.name, with_files);
}

}  // namespace mimicry
