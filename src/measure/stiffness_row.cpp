#include "measure/stiffness_row.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "messages/scene_frame.h"

namespace myotact::measure {

namespace {

template <class Part>
using Field = std::pair<const char*, double Part::*>;

/// Columns after the joint's name, in the order of the CSV. `held` and `converged` stand before the last four, which
/// came later.
constexpr std::array<Field<StiffnessRow>, 11> kColumns = {{{"q_rad", &StiffnessRow::q_rad},
                                                           {"common", &StiffnessRow::common},
                                                           {"difference", &StiffnessRow::difference},
                                                           {"K_schur_Nm_rad", &StiffnessRow::K_schur_Nm_rad},
                                                           {"K_perturbed_Nm_rad", &StiffnessRow::K_perturbed_Nm_rad},
                                                           {"K_line_Nm_rad", &StiffnessRow::K_line_Nm_rad},
                                                           {"net_torque_Nm", &StiffnessRow::net_torque_Nm},
                                                           {"K_muscle_Nm_rad", &StiffnessRow::K_muscle_Nm_rad},
                                                           {"K_geometry_Nm_rad", &StiffnessRow::K_geometry_Nm_rad},
                                                           {"K_contact_Nm_rad", &StiffnessRow::K_contact_Nm_rad},
                                                           {"K_passive_Nm_rad", &StiffnessRow::K_passive_Nm_rad}}};
constexpr std::array<Field<StiffnessRow>, 4> kLaterColumns = {{{"K_low_Nm_rad", &StiffnessRow::K_low_Nm_rad},
                                                               {"K_high_Nm_rad", &StiffnessRow::K_high_Nm_rad},
                                                               {"a_flexors", &StiffnessRow::flexors},
                                                               {"a_extensors", &StiffnessRow::extensors}}};
constexpr std::array<Field<StiffnessRow>, 1> kJsonOnly = {{{"K_gravity_Nm_rad", &StiffnessRow::K_gravity_Nm_rad}}};
constexpr std::array<Field<MusclePart>, 5> kMuscleFields = {{{"activation", &MusclePart::activation},
                                                             {"torque_Nm", &MusclePart::torque_Nm},
                                                             {"K_schur_Nm_rad", &MusclePart::K_schur_Nm_rad},
                                                             {"K_muscle_Nm_rad", &MusclePart::K_muscle_Nm_rad},
                                                             {"K_geometry_Nm_rad", &MusclePart::K_geometry_Nm_rad}}};
constexpr std::array<Field<BandPart>, 2> kBandFields = {
    {{"down_Nm_rad", &BandPart::down_Nm_rad}, {"up_Nm_rad", &BandPart::up_Nm_rad}}};

/// One text for all that could not be found, so that a row that went through JSON gives the same bytes.
std::string cell_text(double value) {
  return std::isfinite(value) ? to_text(value) : "nan";
}

template <class Part, std::size_t kCount>
void write_fields(const Part& part, const std::array<Field<Part>, kCount>& fields, nlohmann::json& object) {
  for (const auto& [name, member] : fields) object[name] = part.*member;
}

template <class Part, std::size_t kCount>
void read_fields(JsonObject& object, const std::array<Field<Part>, kCount>& fields, Part& part) {
  for (const auto& [name, member] : fields) {
    const JsonValue value = object.at(name);
    part.*member = value.raw().is_null() ? std::numeric_limits<double>::quiet_NaN() : value.number();
  }
}

nlohmann::json row_json(const StiffnessRow& row) {
  nlohmann::json object = {
      {"joint", row.joint}, {"held", row.held ? 1 : 0},        {"converged", row.converged ? 1 : 0},
      {"why", row.why},     {"band", nlohmann::json::array()}, {"muscles", nlohmann::json::array()}};
  write_fields(row, kColumns, object);
  write_fields(row, kLaterColumns, object);
  write_fields(row, kJsonOnly, object);
  for (const BandPart& part : row.band) {
    nlohmann::json entry = {{"cause", part.cause}};
    write_fields(part, kBandFields, entry);
    object["band"].push_back(std::move(entry));
  }
  for (const MusclePart& part : row.muscles) {
    nlohmann::json entry = {{"muscle", part.muscle}};
    write_fields(part, kMuscleFields, entry);
    object["muscles"].push_back(std::move(entry));
  }
  if (row.preview) object["mark"] = messages::kPreviewMark;
  return object;
}

StiffnessRow read_row(const JsonValue& value) {
  JsonObject object(value);
  StiffnessRow row;
  row.joint = object.at("joint").string();
  row.held = object.at("held").integer_between(0, 1) == 1;
  row.converged = object.at("converged").integer_between(0, 1) == 1;
  row.why = object.at("why").string();
  read_fields(object, kColumns, row);
  read_fields(object, kLaterColumns, row);
  read_fields(object, kJsonOnly, row);
  for (const JsonValue& entry : object.at("band").elements()) {
    JsonObject fields(entry);
    BandPart& part = row.band.emplace_back();
    part.cause = fields.at("cause").string();
    read_fields(fields, kBandFields, part);
    fields.finish();
  }
  for (const JsonValue& entry : object.at("muscles").elements()) {
    JsonObject fields(entry);
    MusclePart& part = row.muscles.emplace_back();
    part.muscle = fields.at("muscle").string();
    read_fields(fields, kMuscleFields, part);
    fields.finish();
  }
  row.preview = object.find("mark").has_value();
  object.finish();
  return row;
}

}  // namespace

std::string stiffness_csv(const std::vector<StiffnessRow>& rows) {
  std::string csv = "joint";
  for (const auto& [name, member] : kColumns) csv += ',' + std::string(name);
  csv += ",held,converged";
  for (const auto& [name, member] : kLaterColumns) csv += ',' + std::string(name);
  csv += '\n';
  for (const StiffnessRow& row : rows) {
    csv += row.joint;
    for (const auto& [name, member] : kColumns) csv += ',' + cell_text(row.*member);
    csv += row.held ? ",1" : ",0";
    csv += row.converged ? ",1" : ",0";
    for (const auto& [name, member] : kLaterColumns) csv += ',' + cell_text(row.*member);
    csv += '\n';
  }
  return csv;
}

nlohmann::json stiffness_json(const std::vector<StiffnessRow>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const StiffnessRow& row : rows) list.push_back(row_json(row));
  return list;
}

std::vector<StiffnessRow> read_stiffness_rows(const JsonValue& list) {
  std::vector<StiffnessRow> rows;
  for (const JsonValue& entry : list.elements()) rows.push_back(read_row(entry));
  return rows;
}

}  // namespace myotact::measure
