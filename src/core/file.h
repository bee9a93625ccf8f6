#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace myotact {

/// Readers refuse larger files, so that no input can exhaust the memory. The largest canine mesh has 0.2 MB.
inline constexpr std::size_t kLargestInput_bytes = std::size_t{1} << 30;

/// The whole of a regular file. Throws Error: NoInput when it is not there, BadData when it is a folder or too large,
/// InputOutput when reading fails.
std::string read_file(const std::filesystem::path& path);

/// Writes a temporary file beside `path`, flushes it to disk and renames it, so that nothing half-written stays behind.
/// Throws Error InputOutput, also for a device, pipe or folder of that name, which the file would replace.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Renames a file that cannot be used to FILE.broken, which it returns; an older one of that name is replaced. Nothing
/// where that is refused.
std::optional<std::filesystem::path> set_aside(const std::filesystem::path& path);

/// Makes the folder and its parents, and checks that files can be made in it. Throws Error InputOutput.
void make_writable_folder(const std::filesystem::path& folder);

/// Throws the Error that write_file() would: to be asked before long work, not after it.
void require_writable(const std::filesystem::path& path);

/// SHA-256 as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace myotact
