#include "prepare/recipe/surface_files.h"

#include <algorithm>
#include <set>
#include <string>

#include "core/error.h"
#include "core/text.h"

namespace myotact::prepare {

namespace {

namespace fs = std::filesystem;

const std::set<std::string> kExtensions = {".stl", ".obj", ".ply", ".off", ".vtk", ".ele", ".mesh"};

void add_files(const fs::path& folder, std::vector<fs::path>& files) {
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_surface_file(entry.path())) files.push_back(entry.path());
  }
}

}  // namespace

bool is_surface_file(const fs::path& file) {
  return kExtensions.contains(lower(file.extension().string()));
}

std::vector<fs::path> surface_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  bool sorted = false;
  for (const char* kind : {"bones", "muscles"}) {
    if (!fs::is_directory(folder / kind)) continue;
    sorted = true;
    add_files(folder / kind, files);
  }
  if (!sorted) add_files(folder, files);
  if (!sorted && files.empty()) {
    throw Error(ExitStatus::NoInput, folder.string() +
                                         ": holds no surface; a scan is a folder with one surface file a part, best "
                                         "sorted into bones/ and muscles/");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace myotact::prepare
