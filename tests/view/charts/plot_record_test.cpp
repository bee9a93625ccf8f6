// What the plots hold and what their files say.

#include "view/charts/plot_record.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/text.h"

namespace myotact::view {
namespace {

anatomy::Specimen three_muscles() {
  anatomy::Specimen specimen;
  specimen.muscles.resize(3);
  specimen.joints.resize(2);
  return specimen;
}

messages::SceneFrame frame_at(double time_s) {
  messages::SceneFrame frame;
  frame.time_s = time_s;
  frame.joints.resize(2);
  frame.joints[1].angle_rad = std::numbers::pi / 2.0 * std::sin(time_s);
  frame.joints[1].stiffness_Nm_rad = 4.0 + time_s;
  frame.joints[1].torque_Nm = -0.1 * time_s;
  frame.tools.resize(2);
  frame.tools[0].force_world_N = {3.0, 0.0, 4.0};
  frame.tools[1].force_world_N = {0.0, -2.0, 0.0};
  frame.tools[0].parts.contact = {0.0, 3.0, 4.0};
  frame.tools[1].parts.contact = {0.0, 0.0, 1.0};
  frame.tools[0].parts.line = {0.5, 0.0, 0.0};
  frame.tools[1].parts.limits = {0.0, -0.25, 0.0};
  frame.tensions_N = {time_s, 1.0 / 3.0, 2.0 * time_s};
  return frame;
}

std::vector<std::vector<double>> numbers_in(const std::string& csv, std::string& header) {
  std::istringstream lines(csv);
  std::getline(lines, header);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(lines, line);) {
    auto& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(parse_number(cell).value());
  }
  return rows;
}

TEST(PlotRecord, ARowSaysWhatTheFrameSaid) {
  PlotRecord record;
  record.add(three_muscles(), frame_at(0.5), 1);
  ASSERT_EQ(record.size(), 1u);
  EXPECT_NEAR(record.column(PlotRecord::Angle_deg)[0], 90.0 * std::sin(0.5), 1e-12);
  EXPECT_EQ(record.column(PlotRecord::Stiffness_Nm_rad)[0], 4.5);
  EXPECT_EQ(record.column(PlotRecord::Torque_Nm)[0], -0.05);
  EXPECT_EQ(record.column(PlotRecord::Force_N)[0], 7.0);           // 5 N and 2 N
  EXPECT_EQ(record.column(PlotRecord::FirstPart_N)[0], 6.0);       // contact: 5 N and 1 N
  EXPECT_EQ(record.column(PlotRecord::FirstPart_N + 1)[0], 0.0);   // friction
  EXPECT_EQ(record.column(PlotRecord::FirstPart_N + 3)[0], 0.5);   // line
  EXPECT_EQ(record.column(PlotRecord::FirstPart_N + 7)[0], 0.25);  // limits
  EXPECT_EQ(record.column(PlotRecord::tension_column(2))[0], 1.0);
}

TEST(PlotRecord, KeepsAMinuteAndBeginsAnewWithTheClock) {
  PlotRecord record;
  for (int i = 0; i <= 6000; ++i) {
    record.add(three_muscles(), frame_at(0.02 * i), 1);
    record.add(three_muscles(), frame_at(0.02 * i), 1);  // a picture of the same step
  }
  EXPECT_LE(record.times_s().front(), 120.0 - 59.99);
  EXPECT_GE(record.times_s().front(), 120.0 - 65.0);
  EXPECT_EQ(record.column(PlotRecord::Force_N).size(), record.size());
  EXPECT_NEAR(static_cast<double>(record.size() - record.first_within(8.0)), 8.0 / 0.02, 1.5);
  record.add(three_muscles(), frame_at(0.0), 1);
  EXPECT_EQ(record.size(), 1u);
}

TEST(PlotRecord, TheTableHoldsExactlyThePlottedSamples) {
  PlotRecord record;
  for (int i = 0; i < 700; ++i) record.add(three_muscles(), frame_at(0.0137 * i), 1);
  const std::vector<PlotSheet> sheets = {
      {"plots.angle", 1.0, {{"", "elbow_angle_deg", PlotRecord::Angle_deg}}},
      {"plots.tension",
       1.0,
       {{"B", "b_tension_N", PlotRecord::tension_column(1)}, {"C", "c_tension_N", PlotRecord::tension_column(2)}}}};
  const std::size_t first = record.first_within(5.0);
  std::string header;
  const auto rows = numbers_in(csv_of(record, sheets, first), header);
  EXPECT_EQ(header, "time_s,elbow_angle_deg,b_tension_N,c_tension_N");
  ASSERT_EQ(rows.size(), record.size() - first);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i], (std::vector<double>{record.times_s(first)[i], record.column(PlotRecord::Angle_deg, first)[i],
                                            record.column(PlotRecord::tension_column(1), first)[i],
                                            record.column(PlotRecord::tension_column(2), first)[i]}));
  }
}

TEST(PlotRecord, AJointThatIsNotThereLeavesGapsNotZeros) {
  PlotRecord record;
  record.add(three_muscles(), frame_at(0.0), 7);
  EXPECT_TRUE(std::isnan(record.column(PlotRecord::Angle_deg)[0]));
  const PlotSheet sheet{"plots.angle", 1.0, {{"", "angle_deg", PlotRecord::Angle_deg}}};
  EXPECT_EQ(svg_of(record, sheet, 0, {"title", "q", "t"}).find("nan"), std::string::npos);
}

}  // namespace
}  // namespace myotact::view
