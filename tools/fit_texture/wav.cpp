#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/error.h"
#include "core/file.h"
#include "fit_texture/recorded_signal.h"

namespace myotact::fit_texture {

namespace {

constexpr std::uint16_t kPcm = 1, kFloat = 3, kExtensible = 0xfffe;

/// Little-endian number of up to 8 bytes; they must be there.
std::uint64_t number_at(std::string_view bytes, std::size_t place, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[place + i]);
  return value;
}

struct Format {
  std::uint16_t kind = 0, channels = 0, bits = 0;
  std::uint32_t rate_Hz = 0;
};

class WavFile {
 public:
  WavFile(const std::filesystem::path& path, std::string_view bytes) : file_(path.string()), bytes_(bytes) {}

  RecordedSignal read(double full_scale_N) {
    if (bytes_.size() < 12 || bytes_.substr(0, 4) != "RIFF" || bytes_.substr(8, 4) != "WAVE") {
      throw error(0, "is no RIFF WAVE file; give a .wav, or a .csv with the columns of tools/fit_texture/README.md");
    }
    const std::size_t format_at = chunk("fmt ");
    read_format(format_at);
    const std::size_t data_at = chunk("data");
    const std::size_t size = number_at(bytes_, data_at - 4, 4);
    if (size > bytes_.size() - data_at) {
      throw error(data_at,
                  fmt::format("announces {} bytes of samples, the file ends after {}: it is truncated; copy it "
                              "again",
                              size, bytes_.size() - data_at));
    }
    RecordedSignal recording;
    recording.rate_Hz = format_.rate_Hz;
    const std::size_t width = format_.bits / 8u;
    for (std::size_t place = data_at; place + width <= data_at + size; place += width) {
      const double value = sample(place, width);
      if (!std::isfinite(value)) throw error(place, "holds a sample that is not a number; cut it out of the recording");
      recording.signal_N.push_back(full_scale_N * value);
    }
    return recording;
  }

 private:
  Error error(std::size_t byte, const std::string& problem) const {
    return bad_data(file_, fmt::format("byte {}", byte), problem);
  }

  /// Where the content of a chunk begins.
  std::size_t chunk(std::string_view name) const {
    std::size_t place = 12;
    while (place + 8 <= bytes_.size()) {
      const std::size_t size = number_at(bytes_, place + 4, 4);
      if (bytes_.substr(place, 4) == name) return place + 8;
      place += 8 + size + size % 2;
    }
    throw error(std::min(place, bytes_.size()),
                fmt::format("the chunk \"{}\" is missing: the file is truncated or no recording", name));
  }

  void read_format(std::size_t place) {
    const std::size_t size = number_at(bytes_, place - 4, 4);
    if (size < 16 || size > bytes_.size() - place)
      throw error(place, "the chunk \"fmt \" is too short; the file is damaged");
    format_.kind = static_cast<std::uint16_t>(number_at(bytes_, place, 2));
    if (format_.kind == kExtensible && size >= 26)
      format_.kind = static_cast<std::uint16_t>(number_at(bytes_, place + 24, 2));
    format_.channels = static_cast<std::uint16_t>(number_at(bytes_, place + 2, 2));
    format_.rate_Hz = static_cast<std::uint32_t>(number_at(bytes_, place + 4, 4));
    format_.bits = static_cast<std::uint16_t>(number_at(bytes_, place + 14, 2));
    const bool known = (format_.kind == kPcm && (format_.bits == 16 || format_.bits == 24 || format_.bits == 32)) ||
                       (format_.kind == kFloat && (format_.bits == 32 || format_.bits == 64));
    if (!known) {
      throw error(place,
                  fmt::format("samples of kind {} with {} bits; must be PCM of 16, 24 or 32 bits or float of 32 or "
                              "64: export it as one of these",
                              format_.kind, format_.bits));
    }
    if (format_.channels != 1) {
      throw error(place + 2, fmt::format("has {} channels; must have 1: export the axis of the vibration alone",
                                         format_.channels));
    }
  }

  double sample(std::size_t place, std::size_t width) const {
    const std::uint64_t raw = number_at(bytes_, place, width);
    if (format_.kind == kFloat && width == 4) return std::bit_cast<float>(static_cast<std::uint32_t>(raw));
    if (format_.kind == kFloat) return std::bit_cast<double>(raw);
    const std::uint64_t sign = std::uint64_t{1} << (8 * width - 1);
    const auto value = static_cast<std::int64_t>(raw ^ sign) - static_cast<std::int64_t>(sign);
    return static_cast<double>(value) / static_cast<double>(sign);
  }

  std::string file_;
  std::string_view bytes_;
  Format format_;
};

}  // namespace

RecordedSignal read_wav(const std::filesystem::path& path, double full_scale_N) {
  const std::string bytes = read_file(path);
  return WavFile(path, bytes).read(full_scale_N);
}

}  // namespace myotact::fit_texture
