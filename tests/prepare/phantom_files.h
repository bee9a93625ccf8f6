#pragma once

#include <string>
#include <string_view>

#include "prepare/phantom_volume.h"

// The phantom as files, written after the formats' own descriptions and not by the writer of the project.

namespace myotact::testing {

/// Numbers as a file holds them.
struct FileNumbers {
  int bytes = 1;
  bool is_signed = false;
  bool big_endian = false;
};

/// The phantom's labels as such numbers, x fastest.
std::string number_bytes(const PhantomGrid& grid, const FileNumbers& numbers);

/// NRRD with encoding raw, in a space whose axes are these multiples of LPS; `more` are further lines of the header.
std::string nrrd_file(const PhantomGrid& grid, const std::string& space = "left-posterior-superior",
                      const Vec3& signs = Vec3::Ones(), const FileNumbers& numbers = {}, const std::string& more = "");

enum class NiftiPlaces { Affine, Quaternion };
/// NIfTI-1 or -2 in millimetres.
std::string nifti_file(const PhantomGrid& grid, int version, NiftiPlaces places, const FileNumbers& numbers = {});

/// MetaImage whose header ends with `data` ("LOCAL"); without points where that is another file.
std::string meta_image_file(const PhantomGrid& grid, const FileNumbers& numbers = {}, bool packed = false,
                            const std::string& data = "LOCAL");

std::string gzip(std::string_view bytes);
std::string zlib(std::string_view bytes);

}  // namespace myotact::testing
