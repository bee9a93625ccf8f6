#include "simulation/simd/batch.h"

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace myotact::simulation {
namespace {

/// Some numbers of an element, as TetShape and Point are.
template <class Real>
struct Several {
  std::array<Real, 5> value{};
};

/// Allows one unit after the other, and all of them again at the end.
template <class Act>
void on_every_unit(Act&& act) {
  for (const VectorUnit unit : {VectorUnit::Sse2, VectorUnit::Avx2, VectorUnit::Avx512}) {
    allow_vector_unit(unit);
    EXPECT_LE(vector_unit(), unit);
    act();
  }
  allow_vector_unit(VectorUnit::Avx512);
}

/// Ordinary numbers, and those that arithmetic is apt to treat in its own way.
double telling_number(std::mt19937_64& random) {
  constexpr std::array kSpecial{0.0, -0.0, 5e-324, std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::infinity()};
  if (random() % 4 == 0) return kSpecial[random() % kSpecial.size()];
  return std::ldexp(std::uniform_real_distribution<double>(-1.0, 1.0)(random), static_cast<int>(random() % 40) - 20);
}

Several<Eight> telling_numbers(std::mt19937_64& random) {
  Several<Eight> several;
  for (Eight& eight : several.value) {
    for (double& lane : eight.lane) lane = telling_number(random);
  }
  return several;
}

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(RunBatch, MeetsEveryLaneOnceAndLeavesItInItsPlace) {
  std::mt19937_64 random(41);
  for (int round = 0; round < 50; ++round) {
    const Several<Eight> from = telling_numbers(random);
    on_every_unit([&] {
      Several<Eight> to;
      Eight visits;
      run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
        Several<Real> some;
        detail::load<Real>(from, part, some);
        detail::store<Real>(some, part, to);
        for (int lane = part; lane < part + kWidth<Real>; ++lane) visits.lane[lane] += 1.0;
      });
      for (std::size_t lane = 0; lane < kBatch; ++lane) {
        EXPECT_EQ(visits.lane[lane], 1.0);
        for (std::size_t k = 0; k < from.value.size(); ++k) {
          EXPECT_TRUE(same_bits(to.value[k].lane[lane], from.value[k].lane[lane])) << lane << " " << k;
        }
      }
    });
  }
}

/// Written once for any register, and here for one number.
template <class Real>
MYOTACT_INLINE std::array<Real, 5> arithmetic_of(const Real& x, const Real& y) {
  return {larger(x, y), where_less(x, y, constant<Real>(2.0), constant<Real>(-3.0)),
          square_root(x * x + constant<Real>(0.1)), logarithm(x * x + constant<Real>(1e-3)),
          (x + y) * (x - y) / (y * y + constant<Real>(1.0))};
}

TEST(RunBatch, LanesComputeWhatOneNumberDoesOnEveryUnit) {
  std::mt19937_64 random(42);
  for (int round = 0; round < 200; ++round) {
    Several<Eight> in = telling_numbers(random);
    if (round % 2 == 0) in.value[1].lane[round % 8] = in.value[0].lane[round % 8];  // ties
    on_every_unit([&] {
      Several<Eight> out;
      run_batch([&]<class Real>(std::type_identity<Real>, int part) __attribute__((always_inline)) {
        Several<Real> some, result;
        detail::load<Real>(in, part, some);
        result.value = arithmetic_of(some.value[0], some.value[1]);
        detail::store<Real>(result, part, out);
      });
      for (std::size_t lane = 0; lane < kBatch; ++lane) {
        const std::array<double, 5> one = arithmetic_of(in.value[0].lane[lane], in.value[1].lane[lane]);
        for (std::size_t k = 0; k < one.size(); ++k) {
          const double got = out.value[k].lane[lane];
          EXPECT_TRUE(same_bits(got, one[k]) || (std::isnan(got) && std::isnan(one[k]))) << k << " " << got << one[k];
        }
      }
    });
  }
}

TEST(RunBatch, RegistersAreAsWideAsWhatIsAllowed) {
  on_every_unit([] {
    int lanes = 0, bytes = 0;
    run_batch([&]<class Real>(std::type_identity<Real>, int) __attribute__((always_inline)) { lanes = kWidth<Real>; });
    run_for_processor([&]<int kBytes>(std::integral_constant<int, kBytes>)
                          __attribute__((always_inline)) { bytes = kBytes; });
    const int expected = vector_unit() == VectorUnit::Avx512 ? 8 : vector_unit() == VectorUnit::Avx2 ? 4 : 2;
    EXPECT_EQ(lanes, expected);
    EXPECT_EQ(bytes, 8 * expected);
  });
}

}  // namespace
}  // namespace myotact::simulation
