#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/vector.h"
#include "geometry/tet_mesh.h"
#include "geometry/triangle_mesh.h"
#include "geometry/wrap/wrap_path.h"

namespace myotact::anatomy {

// Everything is given in the specimen frame L (= world frame W at the file pose: x cranial, y left, z up), SI units.
// References between parts are indices into the specimen's lists.

struct Bone {
  std::string key, name_la, name_en;
  int body = -1;
  geometry::TriangleMesh surface;
};

struct Body {
  std::string key;
  double mass_kg = 0.0;
  Vec3 com_m = Vec3::Zero();
  std::array<double, 6> inertia_kg_m2{};  // about the centre of mass: xx yy zz xy xz yz
  bool estimated = true;
};

enum class JointType { Hinge, Universal, Ball, Weld };

/// A right-hand rotation of `child` about an axis is flexion; q = 0 at the file pose.
struct Joint {
  std::string key;
  JointType type = JointType::Hinge;
  int parent = -1, child = -1;  // bodies
  Vec3 centre_m = Vec3::Zero();
  std::vector<Vec3> axes;                            // unit; 1 hinge, 2 universal, 3 ball, 0 weld
  std::vector<std::pair<double, double>> range_rad;  // one an axis, lowest .. highest
  double stiffness_Nm_rad = 0.0;
  double damping_Nms_rad = 0.0;
  double centre_uncertainty_m = 0.0;
  double axis_uncertainty_rad = 0.0;
};

enum class TissueRegion : int { Belly = 0, Tendon = 1, Aponeurosis = 2 };

/// How the simulation fitted a muscle's fibres to its line (simulation/limb/calibration.h); n is the normalised fibre
/// length.
struct FibreFit {
  std::uint64_t of = 0;  // fingerprint of the muscle that it was found for; it fits no other
  double offset = 0.0;   // of n
  double scale = 1.0;    // of the peak stress
  double gain = 1.0;     // dn / d(stretch)
  double beyond = 1.0;   // how much of what n exceeds 1 by counts for active force, 0 .. 1
  double force = 1.0;    // isometric force, half active at the file pose, over the line's; 0: none was found
};

struct Muscle {
  std::string key, name_la, name_en, material;
  double peak_force_N = 0.0;     // F0
  double optimal_fibre_m = 0.0;  // lo
  double pennation_rad = 0.0;    // alpha at lo
  double rest_stretch = 0.8;     // fibre length over lo at the file pose with an unstretched tendon
  double tendon_slack_m = 0.0;
  double activation_tau_s = 0.015;
  double deactivation_tau_s = 0.050;
  std::vector<std::string> estimated;  // keys whose values are estimates
  std::vector<std::string> sources;
  geometry::TetMesh tets;
  std::vector<Vec3> fibres;                    // one a tet, unit, from origin to insertion
  std::vector<double> sections_m2;             // one a tet: cross-section of the muscle at that place along the fibres
  std::vector<TissueRegion> regions;           // one a tet
  std::vector<int> attachments;                // one a node: body, or -1
  geometry::TriangleMesh skin;                 // fine surface, embedded in the tets on load
  std::optional<FibreFit> fibre_fit;           // where one is known
  std::optional<FibreFit> fibre_fit_on_bones;  // the same where muscles touch the bones, round which they shorten
};

enum class LinePointKind { Origin, Via, Insertion };

struct LinePoint {
  int body = -1;
  Vec3 position_m = Vec3::Zero();
  LinePointKind kind = LinePointKind::Via;
};

/// A surface that a segment of a line goes round, at most one a segment. It moves with its body. In the file
/// (lines[].wraps[]): body, shape, after, centre_m, side; a cylinder's axis and radius_m, a sphere's radius_m, an
/// ellipsoid's radii_m and axes (three rows).
struct LineWrap {
  int body = -1;
  int after = 0;  // the segment from this point of the line to the next
  geometry::WrapShape shape = geometry::WrapShape::Cylinder;
  Vec3 centre_m = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  // rows: unit, the surface's own x, y and z; a cylinder's axis is z
  Vec3 radii_m = Vec3::Zero();   // along these axes; cylinder and sphere: all the same
  Vec3 side = Vec3::UnitX();     // unit, from the centre: on this side the line goes round, in every pose
};

/// The surface in its own frame, and a point of the specimen frame there.
inline geometry::WrapSurface surface_of(const LineWrap& wrap) {
  return {wrap.shape, wrap.radii_m, wrap.axes * wrap.side};
}
inline Vec3 in_frame_of(const LineWrap& wrap, const Vec3& p_m) {
  return wrap.axes * (p_m - wrap.centre_m);
}

/// From origin to insertion; a point moves with its body.
struct MuscleLine {
  int muscle = -1;
  std::vector<LinePoint> points;
  std::vector<LineWrap> wraps;
};

/// The surface round which the line goes after point `after`, or null.
const LineWrap* wrap_after(const MuscleLine& line, std::size_t after);

struct MuscleGroup {
  int joint = -1;
  std::vector<int> flexors, extensors;  // muscles
};

struct Overlap {
  std::string a, b;
  double depth_m = 0.0;
  double volume_m3 = 0.0;
};

struct Specimen {
  std::string name, species, breed, side, source, licence, created_by;
  std::vector<Bone> bones;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Muscle> muscles;
  std::vector<MuscleLine> lines;
  std::vector<MuscleGroup> groups;
  std::vector<Overlap> overlaps;
};

/// Reads a specimen folder (specimen.json, bones/*.ply, skins/*.ply, muscles/*.vtk, calibration.json) and checks it.
/// Throws Error NoInput or BadData naming file, place, value, allowed range and remedy.
Specimen load_specimen(const std::filesystem::path& folder);
/// The same with `text` in the place of specimen.json; the meshes it names are read from the folder.
Specimen parse_specimen(const std::string& text, const std::filesystem::path& folder);

/// A file that is put beside a specimen's own: its name and its bytes.
using CompanionFiles = std::vector<std::pair<std::string, std::string>>;

/// What can be read of a specimen folder, and all that is wrong with it, one sentence each: what load_specimen() would
/// refuse, file by file and part by part.
struct SpecimenSurvey {
  Specimen specimen;
  std::vector<std::string> defects;
};
/// Throws Error NoInput when there is no specimen.json.
SpecimenSurvey survey_specimen(const std::filesystem::path& folder);

/// Writes the folder completely, or throws Error (InputOutput; BadData for a specimen with a defect) and leaves nothing
/// half-written: the files go to a temporary folder beside it that is renamed at the end. An existing specimen folder
/// is replaced.
void save_specimen(const Specimen& specimen, const std::filesystem::path& folder,
                   const CompanionFiles& companions = {});

/// What makes a specimen unusable, one sentence a defect with place, value and remedy; empty when all is well. Where
/// keys or references are wrong, the rest is not looked at.
std::vector<std::string> find_defects(const Specimen& specimen);
/// Those of one muscle alone, in a specimen of so many bodies.
std::vector<std::string> find_defects(const Muscle& muscle, std::size_t body_count);
/// The first of them, or an empty text.
std::string find_defect(const Specimen& specimen);

/// Index of the muscle with that key, or -1.
int find_muscle(const Specimen& specimen, const std::string& key);
int find_joint(const Specimen& specimen, const std::string& key);
int find_body(const Specimen& specimen, const std::string& key);

}  // namespace myotact::anatomy
