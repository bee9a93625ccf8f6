#include "scene/texture_file.h"

#include <complex>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "haptics/effects/autoregression.h"
#include "support/complaint.h"
#include "support/temporary_folder.h"

namespace myotact::scene {
namespace {

using ::testing::HasSubstr;

class TextureFiles : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    const std::filesystem::path path = folder_.path() / "t.json";
    std::ofstream(path) << text;
    return path;
  }
  std::string complaint_of(const std::string& parts) const {
    const auto path = write(R"({"schema": 1, "tissue": "bone", )" + parts + "}");
    return myotact::testing::complaint(ExitStatus::BadData, [&] { read_texture(path); });
  }

  myotact::testing::TemporaryFolder folder_;
};

std::string vibration(const std::string& nodes) {
  return R"("vibration": {"rate_Hz": 1000, "force_N": [1], "speed_m_s": [0.1, 0.2], "nodes": )" + nodes + "}";
}

TEST_F(TextureFiles, ReadsAllParts) {
  const TextureFile file = read_texture(write(R"({"schema": 1, "tissue": "fascia", "note": "n",
    "relief": {"why": "w", "waves": [{"wavelength_m": 0.001, "angle_rad": 1.5, "height_m": 1e-5, "phase_rad": 0.5}]},
    )" + vibration(R"([[{"rms_N": 0.1, "reflection": [-0.9, 0.5]}, {"rms_N": 0.2, "reflection": [-0.8, 0.4]}]])") +
                                              R"(, "knock": {"frequency_Hz": 80, "decay_s": 0.01, "gain_Ns_m": 2}})"));
  EXPECT_EQ(file.tissue, messages::Tissue::Fascia);
  ASSERT_EQ(file.set.relief.size(), 1u);
  EXPECT_EQ(file.set.relief[0].phase_rad, 0.5);
  EXPECT_EQ(file.set.vibration.order, 2);
  EXPECT_EQ(file.set.vibration.node(0, 1).rms_N, 0.2);
  EXPECT_EQ(file.set.vibration.node(0, 0).reflection[1], 0.5);
  EXPECT_EQ(file.set.knock.gain_Ns_m, 2.0);
}

TEST_F(TextureFiles, NamesThePlaceAndTheRemedyOfWhatIsWrong) {
  EXPECT_THAT(complaint_of(R"("relief": {"waves": [{"wavelength_m": 1, "angle_rad": 0, "height_m": 0}]})"),
              HasSubstr("/relief/waves/0/wavelength_m"));
  EXPECT_THAT(complaint_of(vibration(R"([[{"rms_N": 0.1, "reflection": [-1.0]}, {"rms_N": 0.1, "reflection": [0]}]])")),
              HasSubstr("/vibration/nodes/0/0/reflection/0"));
  EXPECT_THAT(complaint_of(vibration(R"([[{"rms_N": 0.1, "reflection": [-0.9]}]])")), HasSubstr("/vibration/nodes/0"));
  EXPECT_THAT(complaint_of(vibration(R"([[{"rms_N": 0.1, "reflection": [-0.9]}, {"rms_N": 0.1, "reflection": []}]])")),
              HasSubstr("all must have as many"));
  EXPECT_THAT(
      complaint_of(vibration(R"([[{"rms_N": 0.5, "reflection": [-0.9]}, {"rms_N": 0.1, "reflection": [-0.9]}]])")),
      HasSubstr("between 0 and 0.3"));
  EXPECT_THAT(
      complaint_of(vibration(R"([[{"rms_N": 0.1, "reflection": [0.5]}, {"rms_N": 0.1, "reflection": [-0.9]}]])")),
      HasSubstr("tools/fit-texture"));
  EXPECT_THAT(complaint_of(R"("knok": {})"), HasSubstr("knock"));
  EXPECT_THAT(complaint_of(R"("vibration": {"rate_Hz": 10000, "force_N": [1], "speed_m_s": [0.1], "nodes": []})"),
              HasSubstr("/vibration/rate_Hz"));
  EXPECT_THAT(complaint_of(R"("vibration": {"rate_Hz": 1000, "force_N": [2, 1], "speed_m_s": [0.1], "nodes": []})"),
              HasSubstr("/vibration/force_N/1"));
  myotact::testing::complaint(ExitStatus::NoInput, [&] { read_texture(folder_.path() / "none.json"); });
}

TEST(OwnTextures, AreThereForEveryTissueButSkin) {
  const haptics::TextureSettings own = own_textures();
  for (std::size_t tissue = 0; tissue < haptics::kTissueCount; ++tissue) {
    const bool is_skin = tissue == static_cast<std::size_t>(messages::Tissue::Skin);
    EXPECT_EQ(own.by_tissue[tissue].vibration.nodes.empty(), is_skin) << tissue;
    EXPECT_EQ(own.by_tissue[tissue].relief.empty(), is_skin) << tissue;
  }
}

/// The poles that muscle.json names, at 1 N and 0.06 m/s: 72 Hz, 60 Hz wide; 156 Hz, 150 Hz wide.
TEST(OwnTextures, HoldThePolesThatTheirReasonNames) {
  const haptics::VibrationGrid grid = own_textures().by_tissue[0].vibration;
  const haptics::VibrationNode& node = grid.node(2, 2);
  const auto a =
      haptics::prediction_coefficients(std::span(node.reflection.data(), static_cast<std::size_t>(grid.order)));
  for (const auto& [frequency_Hz, width_Hz] : {std::pair{72.0, 60.0}, std::pair{156.0, 150.0}}) {
    const std::complex<double> pole =
        std::polar(std::exp(-std::numbers::pi * width_Hz / 1000.0), 2.0 * std::numbers::pi * frequency_Hz / 1000.0);
    std::complex<double> value = 1.0;
    for (const double coefficient : a) value = value * pole + coefficient;
    EXPECT_LT(std::abs(value), 2e-3) << frequency_Hz;  // the file's numbers have four digits
  }
}

}  // namespace
}  // namespace myotact::scene
