#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

namespace myotact::testing {

/// Breaks bytes in the ways files break. Drawn from a fixed seed, so that a failure comes again.
class Mutator {
 public:
  std::string broken(std::string bytes) {
    const int changes = 1 + below(4);
    for (int i = 0; i < changes && !bytes.empty(); ++i) change(bytes);
    return bytes;
  }

 private:
  int below(std::size_t limit) { return static_cast<int>(random_() % limit); }
  std::size_t place(const std::string& bytes) { return static_cast<std::size_t>(below(bytes.size())); }

  void change(std::string& bytes) {
    static const std::string kTokens[] = {"-1", "nan", "1e999", "99999999999", "\"", "{", "[", "\n", "\xff", "0"};
    switch (below(6)) {
      case 0:
        bytes[place(bytes)] = static_cast<char>(below(256));
        return;
      case 1:
        bytes[place(bytes)] ^= static_cast<char>(1 << below(8));
        return;
      case 2:
        bytes.resize(place(bytes));
        return;
      case 3:
        bytes.erase(place(bytes), static_cast<std::size_t>(below(40)));
        return;
      case 4:
        bytes.insert(place(bytes), bytes.substr(place(bytes), static_cast<std::size_t>(below(60))));
        return;
      default:
        bytes.insert(place(bytes), kTokens[below(std::size(kTokens))]);
        return;
    }
  }

  std::mt19937 random_{20261121};
};

/// Without the flush to disk of write_file and of ext4 (which flushes a file that is cut to zero and written again): it
/// would take longer than the reading.
inline void write_quickly(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::remove(path);
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace myotact::testing
