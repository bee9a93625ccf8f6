#include "core/folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"
#include "core/file.h"

namespace myotact {

namespace fs = std::filesystem;

namespace {

/// Puts the whole folder `fresh` in the place of `target`. What stood there is removed last, and comes back on failure.
void swap_in(const fs::path& fresh, const fs::path& target) {
  const fs::path old = fresh.string() + ".old";
  const bool replaces = fs::exists(target);
  if (replaces) fs::rename(target, old);
  std::error_code failure;
  fs::rename(fresh, target, failure);
  if (failure) {
    if (replaces) fs::rename(old, target);
    throw fs::filesystem_error("cannot be put in place", fresh, target, failure);
  }
  fs::remove_all(old);
}

void refuse_foreign_folder(const fs::path& target, const char* hallmark) {
  if (!fs::exists(target)) return;
  if (fs::is_directory(target) && (fs::is_empty(target) || fs::exists(target / hallmark))) return;
  throw Error(ExitStatus::InputOutput,
              fmt::format("{}: is no empty folder, nor one with a {} that could be replaced; name another folder",
                          target.string(), hallmark));
}

}  // namespace

void write_folder(const fs::path& folder, const char* hallmark, const std::function<void(const fs::path&)>& fill) {
  const fs::path given = fs::absolute(folder).lexically_normal();
  const fs::path target = given.has_filename() ? given : given.parent_path();
  const fs::path temporary = target.string() + fmt::format(".{}.new", ::getpid());
  std::error_code ignored;
  try {
    refuse_foreign_folder(target, hallmark);
    make_writable_folder(target.parent_path());
    make_writable_folder(temporary);
    fill(temporary);
    swap_in(temporary, target);
  } catch (const fs::filesystem_error& failure) {
    fs::remove_all(temporary, ignored);
    throw Error(ExitStatus::InputOutput,
                target.string() + ": " + failure.what() + ". Check the folder and its permissions.");
  } catch (...) {
    fs::remove_all(temporary, ignored);
    throw;
  }
}

}  // namespace myotact
