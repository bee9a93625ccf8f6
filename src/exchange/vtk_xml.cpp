#include "exchange/vtk_xml.h"

#include <bit>
#include <cstring>
#include <span>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::exchange {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are appended as they lie in memory");

/// The file as it grows: the text that describes, and the numbers behind it.
class VtkWriter {
 public:
  std::string text;

  template <class Number>
  void add(const std::string& name, const char* type, std::size_t components, std::span<const Number> values) {
    text += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type,
        escape_markup(name), components, tuples_, numbers_.size());
    const std::uint64_t length = values.size_bytes();
    append(&length, sizeof(length));
    append(values.data(), values.size_bytes());
  }

  void add(const VtkArray& array) {
    const auto components = static_cast<std::size_t>(array.components);
    if (const auto* reals = std::get_if<std::vector<double>>(&array.values)) {
      add<double>(array.name, "Float64", components, *reals);
    } else if (const auto* integers = std::get_if<std::vector<std::int32_t>>(&array.values)) {
      add<std::int32_t>(array.name, "Int32", components, *integers);
    } else {
      add_names(array.name, std::get<std::vector<std::string>>(array.values));
    }
  }

  void add_all(const char* element, const std::vector<VtkArray>& arrays) {
    text += fmt::format("<{}>\n", element);
    for (const VtkArray& array : arrays) add(array);
    text += fmt::format("</{}>\n", element);
  }

  /// Of the whole: it has no points or cells that would say how many there are.
  void add_field(const std::vector<VtkArray>& arrays) {
    if (arrays.empty()) return;
    text += "<FieldData>\n";
    for (const VtkArray& array : arrays) {
      const std::size_t values = std::visit([](const auto& list) { return list.size(); }, array.values);
      tuples_ = fmt::format(" NumberOfTuples=\"{}\"", values / static_cast<std::size_t>(array.components));
      add(array);
    }
    tuples_.clear();
    text += "</FieldData>\n";
  }

  std::string joined(const std::string& end) && {
    text += end;
    text += "<AppendedData encoding=\"raw\">\n_";
    text += numbers_;
    text += "\n</AppendedData>\n</VTKFile>\n";
    return std::move(text);
  }

 private:
  void append(const void* data, std::size_t bytes) {
    if (bytes > 0) numbers_.append(static_cast<const char*>(data), bytes);
  }

  /// Letters as numbers, each word closed by a zero.
  void add_names(const std::string& name, const std::vector<std::string>& names) {
    text += fmt::format("<Array type=\"String\" Name=\"{}\"{} format=\"ascii\">\n", escape_markup(name), tuples_);
    for (const std::string& word : names) {
      for (const char letter : word) text += fmt::format("{} ", static_cast<unsigned char>(letter));
      text += "0\n";
    }
    text += "</Array>\n";
  }

  std::string numbers_;
  std::string tuples_;
};

void add_cells(const VtkPiece& piece, const char* element, VtkWriter& writer) {
  writer.text += fmt::format("<{}>\n", element);
  writer.add<std::int64_t>("connectivity", "Int64", 1, piece.connectivity);
  writer.add<std::int64_t>("offsets", "Int64", 1, piece.offsets);
  if (!piece.surface) writer.add<std::uint8_t>("types", "UInt8", 1, piece.types);
  writer.text += fmt::format("</{}>\n", element);
}

std::string vtk_head(const char* type) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n",
      type);
}

}  // namespace

std::string vtk_xml(const VtkPiece& piece) {
  const char* type = piece.surface ? "PolyData" : "UnstructuredGrid";
  VtkWriter writer;
  writer.text = vtk_head(type) + fmt::format("<{}>\n", type);
  writer.add_field(piece.field_data);
  writer.text += fmt::format("<Piece NumberOfPoints=\"{}\" {}=\"{}\">\n", piece.points_m.size(),
                             piece.surface ? "NumberOfPolys" : "NumberOfCells", piece.offsets.size());
  writer.add_all("PointData", piece.point_data);
  writer.add_all("CellData", piece.cell_data);
  writer.text += "<Points>\n";
  // A Vec3 is three packed doubles.
  const auto* numbers = piece.points_m.empty() ? nullptr : piece.points_m.front().data();
  writer.add<double>("Points", "Float64", 3, std::span<const double>(numbers, 3 * piece.points_m.size()));
  writer.text += "</Points>\n";
  add_cells(piece, piece.surface ? "Polys" : "Cells", writer);
  return std::move(writer).joined(fmt::format("</Piece>\n</{}>\n", type));
}

std::string vtk_series(const std::vector<VtkSeriesEntry>& entries) {
  std::string text = vtk_head("Collection") + "<Collection>\n";
  for (const VtkSeriesEntry& entry : entries) {
    text += fmt::format("<DataSet timestep=\"{}\" part=\"{}\" file=\"{}\"/>\n", to_text(entry.time_s), entry.part,
                        escape_markup(entry.file.generic_string()));
  }
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace myotact::exchange
