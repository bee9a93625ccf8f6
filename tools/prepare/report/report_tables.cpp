#include "prepare/report/report_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/text.h"

namespace myotact::prepare {

namespace {

/// Of mammalian muscle (Mendez and Keys 1960).
constexpr double kMuscleDensity_kg_m3 = 1060.0;

/// Builds one <table>; a column whose heading begins with '#' holds numbers.
class Table {
 public:
  explicit Table(const std::vector<std::string>& headings) {
    for (const std::string& heading : headings) {
      numbers_.push_back(heading.front() == '#');
      html_ += cell("th", heading.substr(numbers_.back() ? 1 : 0), numbers_.back());
    }
    html_ = "<table><tr>" + html_ + "</tr>\n";
  }

  void add(const std::vector<std::string>& cells) {
    html_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) html_ += cell("td", cells[i], numbers_[i]);
    html_ += "</tr>\n";
  }

  std::string html() const { return html_ + "</table>\n"; }

 private:
  static std::string cell(const char* tag, const std::string& text, bool number) {
    return fmt::format("<{0}{1}>{2}</{0}>", tag, number ? R"( class="number")" : "", escape_markup(text));
  }

  std::vector<bool> numbers_;
  std::string html_;
};

std::string fixed(double value, int digits) {
  return fmt::format("{:.{}f}", value, digits);
}

template <class Parts, class Value>
double sum(const Parts& parts, Value&& value) {
  double total = 0.0;
  for (const auto& part : parts) total += value(part.report);
  return total;
}

template <class Value>
const SurfaceReport& largest(const std::vector<MuscleWork>& muscles, Value&& value) {
  return std::max_element(muscles.begin(), muscles.end(),
                          [&](const MuscleWork& a, const MuscleWork& b) { return value(a.report) < value(b.report); })
      ->report;
}

std::string repair_text(const LimbWork& limb) {
  int untouched = 0;
  const SurfaceReport* moved = nullptr;
  const auto look = [&](const auto& parts) {
    for (const auto& part : parts) {
      untouched += part.report.repairs.empty() ? 1 : 0;
      if (part.report.moved_m > (moved ? moved->moved_m : 0.0)) moved = &part.report;
    }
  };
  look(limb.bones);
  look(limb.muscles);
  const std::size_t parts = limb.bones.size() + limb.muscles.size();
  return fmt::format("{} of {} surfaces passed as they were", untouched, parts) +
         (moved ? fmt::format("; {} was moved farthest, by {:.2f} mm", moved->key, 1e3 * moved->moved_m) : "");
}

std::string part_text(const LimbWork& limb) {
  const SurfaceReport& most = largest(limb.muscles, [](const SurfaceReport& r) { return r.parted_loss_m3; });
  return fmt::format("muscles gave way by {:.1f} of {:.1f} cm3; {} most, by {:.1f}",
                     1e6 * sum(limb.muscles, [](const auto& r) { return r.parted_loss_m3; }),
                     1e6 * sum(limb.muscles, [](const auto& r) { return r.volume_m3 + r.parted_loss_m3; }), most.key,
                     1e6 * most.parted_loss_m3);
}

std::string tets_text(const LimbWork& limb) {
  const SurfaceReport& flattest = largest(limb.muscles, [](const auto& r) { return -r.tets.smallest_dihedral_deg; });
  const SurfaceReport& worst = largest(limb.muscles, [](const auto& r) { return -r.tets.mean_ratio; });
  return fmt::format("{:.0f} tets; smallest dihedral angle {:.1f} degrees ({}); lowest mean ratio {:.2f} ({})",
                     sum(limb.muscles, [](const auto& r) { return static_cast<double>(r.tets.tets); }),
                     flattest.tets.smallest_dihedral_deg, flattest.key, worst.tets.mean_ratio, worst.key);
}

std::string attach_text(const LimbWork& limb) {
  const auto gap = [](const SurfaceReport& r) { return std::max(r.origin_gap_m, r.insertion_gap_m); };
  const SurfaceReport& far = largest(limb.muscles, gap);
  return fmt::format("the largest gap between a patch and its bone is {:.1f} mm ({})", 1e3 * gap(far), far.key);
}

std::string skins_text(const LimbWork& limb) {
  const SurfaceReport& deep = largest(limb.muscles, [](const auto& r) { return r.overlap_largest_m; });
  return fmt::format("{} pairs still overlap; deepest point {:.2f} mm ({})", limb.overlaps.size(),
                     1e3 * deep.overlap_largest_m, deep.key);
}

std::string repairs_of(const SurfaceReport& report) {
  std::vector<std::string> texts;
  for (const RepairStep& step : report.repairs) texts.push_back(step_text(step));
  return texts.empty() ? "none" : join(texts, "; ");
}

}  // namespace

std::string stages_table(const LimbWork& limb, int violations) {
  Table table({"stage", "what came of it"});
  const double triangles = sum(limb.bones, [](const auto& r) { return static_cast<double>(r.input_triangles); }) +
                           sum(limb.muscles, [](const auto& r) { return static_cast<double>(r.input_triangles); });
  table.add({"read", fmt::format("{} bones and {} muscles of {:.0f} triangles", limb.bones.size(), limb.muscles.size(),
                                 triangles)});
  table.add({"units and frame", fmt::format("notes: {}, listed below", limb.notes.size())});
  table.add({"repair", repair_text(limb)});
  table.add({"part", part_text(limb)});
  table.add({"remesh", fmt::format("skins of {:.0f} triangles", sum(limb.muscles, [](const auto& r) {
                                     return static_cast<double>(r.skin_triangles);
                                   }))});
  table.add({"tetrahedralise", tets_text(limb)});
  table.add({"attach", attach_text(limb)});
  table.add(
      {"fibres", fmt::format("{:.0f} tets have their neighbours' direction, because the flux there is weak",
                             sum(limb.muscles, [](const auto& r) { return static_cast<double>(r.filled_tets); }))});
  table.add({"lines", fmt::format("{} muscle lines", limb.muscles.size())});
  table.add({"skins", skins_text(limb)});
  table.add({"check", violations == 0 ? "no violation" : fmt::format("violations: {}, listed above", violations)});
  return table.html();
}

std::string bones_table(const LimbWork& limb) {
  Table table({"bone", "#triangles in", "#skin", "#cm3", "repairs", "#moved, mm"});
  for (const BoneWork& bone : limb.bones) {
    const SurfaceReport& r = bone.report;
    table.add({r.key, std::to_string(r.input_triangles), std::to_string(r.skin_triangles), fixed(1e6 * r.volume_m3, 1),
               repairs_of(r), fixed(1e3 * r.moved_m, 2)});
  }
  return table.html();
}

std::string meshes_table(const LimbWork& limb) {
  Table table({"muscle", "#triangles in", "repairs", "#moved, mm", "#lost in parting, cm3", "#skin", "#tets",
               "#smallest angle, degrees", "#1st percentile", "#mean ratio", "#volume error, %", "#cage off by, edges",
               "#overlap p95, mm", "#deepest, mm"});
  for (const MuscleWork& muscle : limb.muscles) {
    const SurfaceReport& r = muscle.report;
    table.add({r.key, std::to_string(r.input_triangles), repairs_of(r), fixed(1e3 * r.moved_m, 2),
               fixed(1e6 * r.parted_loss_m3, 2), std::to_string(r.skin_triangles), std::to_string(r.tets.tets),
               fixed(r.tets.smallest_dihedral_deg, 1), fixed(r.tets.first_percentile_dihedral_deg, 1),
               fixed(r.tets.mean_ratio, 2), fixed(1e2 * r.cage_volume_error, 2),
               fixed(r.cage_deviation_m / r.cage_edge_m, 2), fixed(1e3 * r.overlap_p95_m, 2),
               fixed(1e3 * r.overlap_largest_m, 2)});
  }
  return table.html();
}

std::string architecture_table(const LimbWork& limb) {
  Table table({"muscle", "#volume, cm3", "#mass, g", "#fibre path, mm", "#belly, mm", "#optimal fibre, mm",
               "#pennation, degrees", "#PCSA of this mesh, cm2", "#F0, N", "#F0 / PCSA, kPa", "#origin, mm2",
               "#insertion, mm2", "#gaps to bone, mm", "moment arms, mm (positive flexes)"});
  for (const MuscleWork& muscle : limb.muscles) {
    const SurfaceReport& r = muscle.report;
    const anatomy::Muscle& m = muscle.data.mechanics;
    const double pcsa_m2 = r.volume_m3 * std::cos(m.pennation_rad) / m.optimal_fibre_m;
    std::vector<std::string> moment_arms;
    for (const auto& [joint, moment_arm_m] : r.moment_arms_m)
      moment_arms.push_back(fmt::format("{} {:+.1f}", joint, 1e3 * moment_arm_m));
    table.add({r.key, fixed(1e6 * r.volume_m3, 1), fixed(1e3 * kMuscleDensity_kg_m3 * r.volume_m3, 1),
               fixed(1e3 * r.path_m, 0), fixed(1e3 * r.belly_m, 0), fixed(1e3 * m.optimal_fibre_m, 1),
               fixed(m.pennation_rad * 180.0 / std::numbers::pi, 0), fixed(1e4 * pcsa_m2, 2), fixed(m.peak_force_N, 0),
               fixed(1e-3 * m.peak_force_N / pcsa_m2, 0), fixed(1e6 * r.origin_area_m2, 0),
               fixed(1e6 * r.insertion_area_m2, 0),
               fmt::format("{:.1f} / {:.1f}", 1e3 * r.origin_gap_m, 1e3 * r.insertion_gap_m), join(moment_arms)});
  }
  return table.html();
}

std::string published_table(const LimbWork& limb) {
  Table table({"muscle", "#mass, g", "#published, g", "#part of it", "#published fascicle, mm",
               "#scaled to this mass, mm", "#optimal fibre, mm", "#belly along the fibres, mm"});
  bool any = false;
  for (const MuscleWork& muscle : limb.muscles) {
    const PublishedMuscle& published = muscle.data.published;
    if (published.mass_kg == 0.0) continue;
    any = true;
    const double mass_kg = kMuscleDensity_kg_m3 * muscle.report.volume_m3, part = mass_kg / published.mass_kg;
    table.add({muscle.report.key, fixed(1e3 * mass_kg, 1), fixed(1e3 * published.mass_kg, 1), fixed(part, 2),
               fixed(1e3 * published.fascicle_m, 1), fixed(1e3 * published.fascicle_m * std::cbrt(part), 1),
               fixed(1e3 * muscle.data.mechanics.optimal_fibre_m, 1), fixed(1e3 * muscle.report.belly_m, 0)});
  }
  return any ? table.html() : "";
}

std::string overlaps_table(const std::vector<anatomy::Overlap>& overlaps) {
  Table table({"of", "and", "#deepest, mm", "#cm3"});
  for (const anatomy::Overlap& overlap : overlaps) {
    table.add({overlap.a, overlap.b, fixed(1e3 * overlap.depth_m, 2), fixed(1e6 * overlap.volume_m3, 3)});
  }
  return table.html();
}

}  // namespace myotact::prepare
