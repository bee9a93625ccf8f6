#include "simulation/solid/law_batch.h"

#include "core/dense_matrix.h"

namespace myotact::simulation {
namespace {

template <class SomeLaw>
constexpr bool kHasFibre = requires(const SomeLaw& law) {
  law.curve;
};

}  // namespace

void respond(const Law& law, const Point<Eight>& point, double activation, Response<Eight>& response) {
  std::visit(
      [&](const auto& some_law) {
        run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
          Point<Real> here;
          Response<Real> out;
          detail::load<Real>(point, part, here);
          detail::load<Real>(response, part, out);
          some_law.add(here, constant<Real>(activation), out);
          detail::store<Real>(out, part, response);
        });
      },
      law);
}

VolumeTerm<Eight> volume_terms(const std::vector<Law>& laws, const Eight& J) {
  VolumeTerm<Eight> sum;
  for (const Law& law : laws) {
    std::visit(
        [&](const auto& some_law) {
          run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
            Real ratio;
            VolumeTerm<Real> total;
            detail::load<Real>(J, part, ratio);
            detail::load<Real>(sum, part, total);
            const VolumeTerm<Real> term = some_law.volume(ratio);
            total = {total.energy_Pa + term.energy_Pa, total.slope_Pa + term.slope_Pa,
                     total.curvature_Pa + term.curvature_Pa};
            detail::store<Real>(total, part, sum);
          });
        },
        law);
  }
  return sum;
}

double shape_energy_Pa(const std::vector<Law>& laws, const Point<double>& point, double activation) {
  Response<double> response;
  for (const Law& law : laws) {
    std::visit([&](const auto& some_law) { some_law.add_energy(point, activation, response); }, law);
  }
  return response.energy_Pa;
}

VolumeTerm<double> volume_term_at(const std::vector<Law>& laws, double J) {
  VolumeTerm<double> sum;
  for (const Law& law : laws) {
    const auto term = std::visit([&](const auto& some_law) { return some_law.template volume<double>(J); }, law);
    sum = {sum.energy_Pa + term.energy_Pa, sum.slope_Pa + term.slope_Pa, sum.curvature_Pa + term.curvature_Pa};
  }
  return sum;
}

double volume_energy_Pa(const std::vector<Law>& laws, double J) {
  return volume_term_at(laws, J).energy_Pa;
}

Response<double> respond_at(const std::vector<Law>& laws, const Point<double>& point, double activation) {
  Response<double> response;
  for (const Law& law : laws) {
    std::visit(
        [&](const auto& some_law) {
          some_law.add(point, activation, response);
          add_volume(point, some_law.template volume<double>(point.J), response);
        },
        law);
  }
  return response;
}

void add_volume_at(const Point<Eight>& point, const VolumeTerm<Eight>& term, Response<Eight>& response) {
  run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
    Point<Real> here;
    VolumeTerm<Real> volume;
    Response<Real> out;
    detail::load<Real>(point, part, here);
    detail::load<Real>(term, part, volume);
    detail::load<Real>(response, part, out);
    add_volume(here, volume, out);
    detail::store<Real>(out, part, response);
  });
}

void make_definite(std::array<double, kPacked>& C) {
  Eigen::MatrixXd whole(9, 9);
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t c = r; c < 9; ++c) {
      whole(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          whole(static_cast<Eigen::Index>(c), static_cast<Eigen::Index>(r)) = C[packed(r, c)];
    }
  }
  const SymmetricEigen split = symmetric_eigen(whole);
  if (split.values[0] >= 0.0) return;
  whole = positive_part(split);
  for (std::size_t r = 0; r < 9; ++r) {
    for (std::size_t c = r; c < 9; ++c) {
      C[packed(r, c)] = whole(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
    }
  }
}

void make_definite(std::array<Eight, kPacked>& C) {
  for (std::size_t lane = 0; lane < kBatch; ++lane) {
    std::array<double, kPacked> one;
    for (std::size_t k = 0; k < kPacked; ++k) one[k] = C[k].lane[lane];
    make_definite(one);
    for (std::size_t k = 0; k < kPacked; ++k) C[k].lane[lane] = one[k];
  }
}

bool needs_fibre(const Law& law) {
  return std::visit([]<class SomeLaw>(const SomeLaw&) { return kHasFibre<SomeLaw>; }, law);
}

}  // namespace myotact::simulation
