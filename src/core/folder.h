#pragma once

#include <filesystem>
#include <functional>

namespace myotact {

/// Fills a folder wholly or not at all: `fill` writes into a temporary one beside it, which is put in its place at the
/// end. Replaces an empty folder or one that holds a file named `hallmark`; anything else is not ours to remove. Throws
/// Error InputOutput, and what `fill` throws; then nothing new is left behind.
void write_folder(const std::filesystem::path& folder, const char* hallmark,
                  const std::function<void(const std::filesystem::path&)>& fill);

}  // namespace myotact
