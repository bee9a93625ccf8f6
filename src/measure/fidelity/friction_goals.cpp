#include "measure/fidelity/friction_goals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "core/data_folder.h"
#include "geometry/mesh_files.h"
#include "measure/fidelity/rubbed_tissue.h"

namespace myotact::measure {

namespace {

constexpr double kTick_s = RubbedTissue::kTick_s;

/// The worst over many runs, each of many ticks.
struct Worst {
  double mean_percent = 0.0;  // of a run's mean coefficient against the one asked for
  double deviation = 0.0;     // standard deviation of the coefficient within a run
  double breakaway_percent = 0.0;
  double all_percent = 0.0;       // as mean_percent, with the ticks at edges
  double at_edges_percent = 0.0;  // ticks that have no one normal, or in which an edge holds the tool
};

constexpr double kSameNormal = 1.0 - 5e-5;  // cosine of 0.01 rad

/// What one run of ticks feels.
class Felt {
 public:
  explicit Felt(double expected) : expected_(expected) {}

  /// A tick at an edge has no one normal to measure by, and a fold may hold the tool for a while: reported separately.
  void add(const RubbedTissue& rub, double along_N) {
    const haptics::ProxyContact& contact = rub.proxy().contact();
    const double error = along_N / rub.force_N().dot(contact.normal) - expected_;
    all_.add(error);
    const bool at_edge = contact.normal.dot(normal_) < kSameNormal || !contact.sliding;
    normal_ = contact.normal;
    if (!at_edge) inside_.add(error);
  }
  void report(Worst& worst) const {
    const double mean = inside_.sum / inside_.count;
    worst.mean_percent = std::max(worst.mean_percent, 100.0 * std::abs(mean) / expected_);
    worst.deviation =
        std::max(worst.deviation, std::sqrt(std::max(0.0, inside_.squares / inside_.count - mean * mean)));
    worst.all_percent = std::max(worst.all_percent, 100.0 * std::abs(all_.sum / all_.count) / expected_);
    worst.at_edges_percent = std::max(worst.at_edges_percent, 100.0 * (1.0 - 1.0 * inside_.count / all_.count));
  }

 private:
  struct Sums {
    void add(double x) {
      ++count;
      sum += x;
      squares += x * x;
    }
    int count = 0;
    double sum = 0.0, squares = 0.0;
  };

  double expected_;
  Sums all_, inside_;
  Vec3 normal_ = Vec3::Zero();
};

/// Square of `cells` x `cells` cells in the plane z = 0, or laid round the y axis with `bend_m` as its radius.
geometry::TriangleMesh make_sheet(double side_m, int cells, double bend_m = 0.0) {
  geometry::TriangleMesh mesh;
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double x = side_m * i / cells - 0.5 * side_m, y = side_m * j / cells - 0.5 * side_m;
      const double turn_rad = bend_m > 0.0 ? x / bend_m : 0.0;
      mesh.positions_m.push_back(
          bend_m > 0.0 ? Vec3(bend_m * std::sin(turn_rad), y, bend_m * std::cos(turn_rad) - bend_m) : Vec3(x, y, 0.0));
    }
  }
  for (int j = 0; j < cells; ++j) {
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + cells + 2});
      mesh.triangles.push_back({a, a + cells + 2, a + cells + 1});
    }
  }
  return mesh;
}

/// Fibres along x on a sheet.
std::vector<messages::TriangleTissue> fibres_along_x(const geometry::TriangleMesh& sheet) {
  std::vector<messages::TriangleTissue> tissue(sheet.triangles.size());
  for (std::size_t i = 0; i < tissue.size(); ++i) {
    const auto& [a, b, c] = sheet.triangles[i];
    const Vec3 first = sheet.positions_m[static_cast<std::size_t>(b)] - sheet.positions_m[static_cast<std::size_t>(a)];
    const Vec3 second = sheet.positions_m[static_cast<std::size_t>(c)] - sheet.positions_m[static_cast<std::size_t>(a)];
    const double area = first.x() * second.y() - first.y() * second.x();
    tissue[i].fibre_edges = {static_cast<float>(second.y() / area), static_cast<float>(-first.y() / area)};
  }
  return tissue;
}

Vec3 along_surface_N(const RubbedTissue& rub) {
  const Vec3 normal = rub.proxy().contact().normal;
  return rub.force_N() - rub.force_N().dot(normal) * normal;
}

haptics::ContactSettings settings_of(double mu_static, double mu_dynamic) {
  haptics::ContactSettings settings;
  settings.static_friction = mu_static;
  settings.dynamic_friction = mu_dynamic;
  return settings;
}

// ---- a plane: every coefficient, speed and force of the goal

struct Slide {
  double mu = 0.3;
  double speed_m_s = 0.02;
  double normal_N = 1.0;
};

void slide_on_plane(const geometry::TriangleMesh& plane, const Slide& slide, Worst& worst) {
  const haptics::ContactSettings settings = settings_of(slide.mu, slide.mu);
  RubbedTissue rub(plane, settings);
  const double depth_m = slide.normal_N / settings.stiffness_N_m;
  const Vec3 way = Vec3(0.9, 0.43, 0.0).normalized();
  const double drawn_m = 1.05 * slide.mu * depth_m;  // by then the coupling's spring is drawn and it slides
  const double length_m = drawn_m + std::max(3e-3, 0.1 * slide.speed_m_s);
  const Vec3 start_m = -0.5 * length_m * way + Vec3(0, 0, settings.radius_m);
  for (int tick = 0; tick < 10; ++tick) rub.tick(start_m + Vec3(0, 0, 1e-3));
  for (int tick = 0; tick < 10; ++tick) rub.tick(start_m - Vec3(0, 0, depth_m));
  Felt felt(slide.mu);
  for (double gone_m = 0.0; gone_m < length_m; gone_m += slide.speed_m_s * kTick_s) {
    rub.tick(start_m - Vec3(0, 0, depth_m) + gone_m * way);
    if (gone_m > drawn_m) felt.add(rub, along_surface_N(rub).norm());
  }
  felt.report(worst);
}

Worst slides_on_plane(Effort effort) {
  const geometry::TriangleMesh plane = make_sheet(0.08, 32);
  Worst worst;
  const bool full = effort == Effort::Full;
  for (const double mu : full ? std::vector{0.1, 0.2, 0.3, 0.45, 0.6} : std::vector{0.1, 0.6}) {
    for (const double speed_m_s : full ? std::vector{0.001, 0.005, 0.02, 0.05, 0.1, 0.2} : std::vector{0.002, 0.2}) {
      for (const double normal_N : full ? std::vector{0.2, 0.5, 1.0, 2.0, 3.0} : std::vector{0.2, 3.0}) {
        slide_on_plane(plane, {mu, speed_m_s, normal_N}, worst);
      }
    }
  }
  return worst;
}

// ---- fibres: every direction

/// Static 1.25 times dynamic, along the fibres 0.6 of across them; closed forms of the ellipse.
void slide_over_fibres(double angle_rad, double normal_N, Worst& worst) {
  const double mu = 0.24, ratio = 0.6;
  haptics::ContactSettings settings = settings_of(1.25 * mu, mu);
  settings.along_over_across = ratio;
  const geometry::TriangleMesh plane = make_sheet(0.06, 24);
  RubbedTissue rub(plane, settings, fibres_along_x(plane));
  const Vec3 way(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  const double depth_m = normal_N / settings.stiffness_N_m, speed_m_s = 0.1;
  const Vec3 start_m = Vec3(0, 0, settings.radius_m - depth_m) - 10e-3 * way;
  for (int tick = 0; tick < 10; ++tick) rub.tick(start_m + Vec3(0, 0, 2.0 * depth_m));
  for (int tick = 0; tick < 10; ++tick) rub.tick(start_m);
  const Vec3 stuck_m = rub.proxy().position_m();
  double highest = 0.0, gone_m = 0.0;
  for (; (rub.proxy().position_m() - stuck_m).norm() < 2e-6 && gone_m < 5e-3; gone_m += 2e-6) {
    rub.tick(start_m + gone_m * way);
    highest = std::max(highest, along_surface_N(rub).norm() / rub.force_N().z());
  }
  const double breakaway = 1.25 * mu / std::hypot(std::cos(angle_rad) / ratio, std::sin(angle_rad));
  worst.breakaway_percent = std::max(worst.breakaway_percent, 100.0 * std::abs(highest / breakaway - 1.0));
  Felt felt(mu * std::hypot(ratio * std::cos(angle_rad), std::sin(angle_rad)));
  for (const double end_m = gone_m + 20e-3, from_m = gone_m + 10e-3; gone_m < end_m; gone_m += speed_m_s * kTick_s) {
    rub.tick(start_m + gone_m * way);
    if (gone_m > from_m) felt.add(rub, -rub.force_N().dot(way));
  }
  felt.report(worst);
}

Worst slides_over_fibres(Effort effort) {
  Worst worst;
  const int directions = effort == Effort::Full ? 24 : 5;
  for (int k = 0; k < directions; ++k) {
    for (const double normal_N : {0.2, 1.0, 3.0}) {
      slide_over_fibres(2.0 * std::numbers::pi * k / directions + 0.07, normal_N, worst);
    }
  }
  return worst;
}

// ---- surfaces that are not flat

/// A device that keeps its depth below the sphere while it goes along the surface.
class Stroke {
 public:
  Stroke(RubbedTissue& rub, const Vec3& start_m, const Vec3& out, double depth_m)
      : rub_(rub), device_m_(start_m + 6e-3 * out), depth_m_(depth_m) {
    for (int tick = 0; tick < 400 && below_m() < depth_m_; ++tick) go(-5e-5 * out);
  }

  /// One tick along `way`, as seen in the plane of the contact. False: the surface was lost.
  bool along(const Vec3& way, double speed_m_s) {
    const haptics::ProxyContact& contact = rub_.proxy().contact();
    if (!contact.active) return false;
    const Vec3 in_plane = (way - way.dot(contact.normal) * contact.normal).normalized();
    go(speed_m_s * kTick_s * in_plane + (below_m() - depth_m_) * contact.normal);
    return true;
  }

 private:
  double below_m() const {
    const haptics::ProxyContact& contact = rub_.proxy().contact();
    return contact.active ? contact.normal.dot(rub_.proxy().position_m() - device_m_) : 0.0;
  }
  void go(const Vec3& step_m) {
    device_m_ += step_m;
    rub_.tick(device_m_);
  }

  RubbedTissue& rub_;
  Vec3 device_m_;
  double depth_m_;
};

struct Curved {
  geometry::TriangleMesh mesh;
  Vec3 start_m = Vec3::Zero(), out = Vec3::UnitZ(), way = Vec3::UnitX();
};

Worst slides_on(const Curved& curved, Effort effort) {
  Worst worst;
  for (const double mu : effort == Effort::Full ? std::vector{0.1, 0.3, 0.6} : std::vector{0.3}) {
    for (const double speed_m_s : {0.01, 0.05, 0.2}) {
      const haptics::ContactSettings settings = settings_of(mu, mu);
      RubbedTissue rub(curved.mesh, settings);
      Stroke stroke(rub, curved.start_m, curved.out, 1.0 / settings.stiffness_N_m);
      Felt felt(mu);
      const int ticks = static_cast<int>(15e-3 / (speed_m_s * kTick_s));
      const int drawn = static_cast<int>(1.5e-3 / (speed_m_s * kTick_s));
      for (int tick = 0; tick < ticks && stroke.along(curved.way, speed_m_s); ++tick) {
        if (tick > drawn) felt.add(rub, along_surface_N(rub).norm());
      }
      felt.report(worst);
    }
  }
  return worst;
}

/// The long head of triceps of the built-in elbow, from the middle of its caudal side towards its insertion.
Curved muscle_of_the_elbow() {
  Curved curved;
  curved.mesh = geometry::read_ply(data_folder() / "meshes" / "canine_elbow" / "skins" / "triceps_brachii_long.ply");
  const auto corner = [&](const std::array<int, 3>& triangle, std::size_t i) {
    return curved.mesh.positions_m[static_cast<std::size_t>(triangle[i])];
  };
  Vec3 middle_m = Vec3::Zero();
  for (const Vec3& x : curved.mesh.positions_m) middle_m += x / static_cast<double>(curved.mesh.positions_m.size());
  double best = -1e9;
  for (const std::array<int, 3>& triangle : curved.mesh.triangles) {
    const Vec3 centre_m = (corner(triangle, 0) + corner(triangle, 1) + corner(triangle, 2)) / 3.0;
    const Vec3 out = (corner(triangle, 1) - corner(triangle, 0)).cross(corner(triangle, 2) - corner(triangle, 0));
    const double score = -out.normalized().x() - 40.0 * std::abs(centre_m.z() - middle_m.z());
    if (score <= best) continue;
    best = score;
    curved.start_m = centre_m;
    curved.out = out.normalized();
  }
  curved.way = -Vec3::UnitZ();
  return curved;
}

void report(const std::string& where, const Worst& worst, GoalFigures& result) {
  result.figures.push_back({where + ", mean error of mu", worst.mean_percent, "%", 1.0});
  result.figures.push_back({where + ", SD of mu", worst.deviation, "", 0.005});
}

}  // namespace

GoalFigures measure_friction_coefficient(Effort effort) {
  GoalFigures result;
  report("plane, mu .1-.6, 1-200 mm/s, 0.2-3 N", slides_on_plane(effort), result);
  const Worst fibres = slides_over_fibres(effort);
  report("over fibres, all directions", fibres, result);
  result.figures.push_back({"over fibres, all directions, breakaway", fibres.breakaway_percent, "%", 3.0});
  const Curved cylinder{make_sheet(0.06, 60, 0.025), Vec3::Zero(), Vec3::UnitZ(), Vec3(0.8, 0.6, 0.0)};
  report("cylinder of 25 mm, 1 N", slides_on(cylinder, effort), result);
  const Worst muscle = slides_on(muscle_of_the_elbow(), effort);
  report("triceps of the elbow, facets of some 4 mm, 1 N", muscle, result);
  result.note = fmt::format(
      "the worst of all runs; on the muscle {:.2g} % of the ticks are left out, in which the normal changes at an edge "
      "or a "
      "fold holds the tool: with them the mean is off by {:.2g} %",
      muscle.at_edges_percent, muscle.all_percent);
  return result;
}

namespace {

/// Swings, rotates and stretches as a whole, some 20 mm and 10 %: a limb that is moved while a finger rests on it.
Vec3 swung(const Vec3& x, const Vec3& pivot_m, double time_s) {
  const auto wave = [time_s](double hz) { return std::sin(2.0 * std::numbers::pi * hz * time_s); };
  const double longer = 1.0 + 0.1 * wave(0.7), thinner = 1.0 / std::sqrt(longer);
  const Vec3 stretched_m = (x - pivot_m).cwiseProduct(Vec3(longer, thinner, thinner));
  const Eigen::AngleAxisd rotation(0.5 * wave(0.31), Vec3(0.3, 0.8, 0.52).normalized());
  return pivot_m + rotation * stretched_m + Vec3(20e-3 * wave(0.5), 10e-3 * wave(0.23), 5e-3 * wave(1.1));
}

/// A finger that presses 2 N on a place of the swinging tissue and trembles by 0.2 mm at 9 Hz: how far it creeps [m],
/// NaN if it loses the tissue.
double creep_m(const Curved& tissue, double seconds) {
  const Vec3 pivot_m = tissue.start_m + Vec3(0.02, 0.01, 0.03);
  haptics::ContactSettings settings = settings_of(0.3, 0.25);
  RubbedTissue rub(tissue.mesh, settings, {}, [&](double time_s, std::vector<Vec3>& positions_m) {
    for (std::size_t i = 0; i < positions_m.size(); ++i)
      positions_m[i] = swung(tissue.mesh.positions_m[i], pivot_m, time_s);
  });
  const Vec3 side = tissue.out.cross(tissue.way).normalized();
  Vec3 first_m = Vec3::Zero();
  double farthest_m = 0.0;
  for (int tick = 1; tick <= static_cast<int>(seconds / kTick_s); ++tick) {
    const double time_s = kTick_s * tick;
    const double depth_m = std::min(2.5e-3, 1e-2 * (time_s - 0.1));  // comes from 1 mm outside
    const Vec3 tremor_m = 0.2e-3 * std::sin(2.0 * std::numbers::pi * 9.0 * time_s) * side;
    // Through the tissue's motion: a place below the skin moves with it.
    const Vec3 below_m = tissue.start_m + (settings.radius_m - depth_m) * tissue.out + tremor_m;
    rub.tick(swung(below_m, pivot_m, time_s));
    if (tick == 500) first_m = rub.contact_rest_m();
    if (tick > 500) farthest_m = std::max(farthest_m, (rub.contact_rest_m() - first_m).norm());
    if (tick > 500 && !rub.proxy().contact().active) return std::nan("");
  }
  return farthest_m;
}

}  // namespace

GoalFigures measure_sticking(Effort effort) {
  const double seconds = effort == Effort::Full ? 60.0 : 6.0;
  const Curved plane{make_sheet(0.06, 24), Vec3(1.3e-3, 0.7e-3, 0.0), Vec3::UnitZ(), Vec3::UnitX()};
  GoalFigures result;
  result.figures = {{"plane", 1e6 * creep_m(plane, seconds), "um", 20.0},
                    {"triceps of the elbow", 1e6 * creep_m(muscle_of_the_elbow(), seconds), "um", 20.0}};
  result.note = fmt::format(
      "{} s; tissue swings by 20 mm, rotates by 0.5 rad and stretches by 10 %, the finger trembles by "
      "0.2 mm at 9 Hz; how far the touched material moves",
      seconds);
  return result;
}

}  // namespace myotact::measure
