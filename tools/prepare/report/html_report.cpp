#include "prepare/report/html_report.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"
#include "core/text.h"
#include "prepare/report/histogram.h"
#include "prepare/report/part_pictures.h"
#include "prepare/report/report_tables.h"

namespace myotact::prepare {

namespace {

constexpr const char* kStyle = R"(<style>
body { font: 14px sans-serif; color: #222222; margin: 2em; }
table { border-collapse: collapse; margin: 0.5em 0; }
th, td { border-bottom: 1px solid #dddddd; padding: 2px 8px; text-align: left; vertical-align: top; }
th { font-weight: normal; color: #555555; }
.number { text-align: right; font-variant-numeric: tabular-nums; }
.parts { display: grid; grid-template-columns: repeat(auto-fill, minmax(610px, 1fr)); gap: 1.5em; }
.parts h3 { margin: 0 0 0.3em 0; }
img { border: 1px solid #eeeeee; }
.wide { overflow-x: auto; }
</style>)";

/// Dihedral angles and mean ratios of a muscle's tets, with the limits that preparation promises.
std::string histograms(const geometry::TetMesh& tets) {
  std::vector<double> angles_deg, ratios;
  for (std::size_t t = 0; t < tets.corners.size(); ++t) {
    const TetCorners corners = corners_of(tets, t);
    const auto angles = dihedrals_deg(corners);
    angles_deg.insert(angles_deg.end(), angles.begin(), angles.end());
    ratios.push_back(mean_ratio_of(corners));
  }
  return histogram_svg(angles_deg, {"dihedral angles", "°", 0.0, 180.0, 36, 5.0}) + " " +
         histogram_svg(ratios, {"mean ratios", "", 0.0, 1.0, 25, 0.7});
}

std::string image(const std::string& png, const std::string& what) {
  return fmt::format(R"(<img alt="{}" title="{}" src="data:image/png;base64,{}">)", escape_markup(what),
                     escape_markup(what), png);
}

std::string images(const PicturePair& pair, const std::string& what) {
  return image(pair.lateral, what + ", lateral") + " " + image(pair.medial, what + ", medial");
}

std::string notes_list(const std::vector<std::string>& notes) {
  if (notes.empty()) return "";
  std::string html = "<ul>";
  for (const std::string& note : notes) html += "<li>" + escape_markup(note) + "</li>\n";
  return html + "</ul>\n";
}

std::string marks_legend() {
  std::string html = "<p>Marks:";
  for (const MarkColour& colour : mark_colours()) {
    html += fmt::format(R"( <span style="color:{}">&#9679;</span> {})", colour.html, colour.meaning);
  }
  return html + ". Red tubes are muscle lines.</p>\n";
}

std::string decisions(const LimbWork& limb, const std::vector<std::string>& violations) {
  std::vector<std::string> items = violations;
  const auto add = [&](const auto& parts) {
    for (const auto& part : parts) {
      for (const std::string& note : part.report.notes) items.push_back(part.report.key + ": " + note);
    }
  };
  add(limb.bones);
  add(limb.muscles);
  std::string html = "<h2>For a person to decide</h2>\n";
  html += items.empty() ? "<p>Nothing.</p>\n" : notes_list(items);
  std::vector<std::string> estimates;
  for (const MuscleWork& muscle : limb.muscles) {
    const anatomy::Muscle& m = muscle.data.mechanics;
    if (!m.estimated.empty()) estimates.push_back(m.key + ": " + join(m.estimated));
  }
  if (estimates.empty()) return html;
  return html + "<details><summary>Estimates, to be replaced by measurements where there are any</summary>" +
         notes_list(estimates) + "</details>\n";
}

/// All parts, one after the other.
std::string parts(const LimbWork& limb, const anatomy::Specimen& specimen) {
  std::string html = marks_legend() + "<div class=\"parts\">\n";
  for (std::size_t m = 0; m < limb.muscles.size(); ++m) {
    const SurfaceReport& report = limb.muscles[m].report;
    html += fmt::format("<div><h3>{}</h3>{}<br>{}{}</div>\n", escape_markup(report.key),
                        images(picture_of_muscle(specimen, m, report.marks), report.key),
                        histograms(specimen.muscles[m].tets), notes_list(report.notes));
  }
  for (std::size_t b = 0; b < limb.bones.size(); ++b) {
    const SurfaceReport& report = limb.bones[b].report;
    html += fmt::format("<div><h3>{}</h3>{}{}</div>\n", escape_markup(report.key),
                        images(picture_of_bone(specimen, b, report.marks), report.key), notes_list(report.notes));
  }
  return html + "</div>\n";
}

std::string wide(const std::string& table) {
  return "<div class=\"wide\">" + table + "</div>\n";
}

}  // namespace

std::string html_report(const LimbWork& limb, const anatomy::Specimen& specimen,
                        const std::vector<std::string>& violations) {
  const std::string title = fmt::format("{}, {} side: how it was prepared", specimen.name, specimen.side);
  std::string limb_pictures, part_pictures;
  try {
    limb_pictures = images(picture_of_limb(specimen), specimen.name);
    part_pictures = parts(limb, specimen);
  } catch (const Error& failure) {
    if (failure.status() != ExitStatus::Unavailable) throw;
    part_pictures = fmt::format("<p>{}</p>\n", escape_markup(failure.what()));
  }
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>{1}</head><body>\n"
      "<h1>{0}</h1>\n<p>{2}. Licence: {3}.</p>\n",
      escape_markup(title), kStyle, escape_markup(specimen.source), escape_markup(specimen.licence));
  html += limb_pictures + decisions(limb, violations);
  html += "<h2>Stages</h2>\n" + stages_table(limb, static_cast<int>(violations.size()));
  if (!limb.notes.empty()) html += "<h3>Notes on reading, units and frame</h3>\n" + notes_list(limb.notes);
  html += "<h2>Muscles: architecture</h2>\n" + wide(architecture_table(limb));
  if (const std::string published = published_table(limb); !published.empty()) {
    html +=
        "<h2>Muscles: beside published ones</h2>\n<p>" + escape_markup(limb.anatomy.published_source) +
        ". Fascicle lengths scale with the cube root of the mass. Where a mesh has long tendons or is pennate, fibres "
        "of its mesh run farther than its fascicles: forces and stiffness follow the optimal fibre.</p>\n" +
        wide(published);
  }
  html += "<h2>Muscles: meshes</h2>\n" + wide(meshes_table(limb));
  html += "<h2>Bones</h2>\n" + wide(bones_table(limb));
  if (!specimen.overlaps.empty()) html += "<h2>Overlaps that are left</h2>\n" + overlaps_table(specimen.overlaps);
  html += "<h2>Parts</h2>\n" + part_pictures;
  return html + "</body></html>\n";
}

}  // namespace myotact::prepare
