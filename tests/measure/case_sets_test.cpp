#include "measure/case_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "geometry/box_mesh.h"
#include "measure/case_example.h"

namespace myotact::measure {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CaseSets : public ::testing::Test {
 protected:
  void SetUp() override {
    mesh_.file = "bar.vtk";
    mesh_.mesh = geometry::make_box_mesh(Vec3(2, 1, 1), {2, 1, 1});
    for (int n = 0; n < 12; ++n) mesh_.node_of_file.push_back(n);
  }
  NodeSet read(const json& set) const {
    const json sets = {{"s", set}};
    return read_sets(JsonValue(sets, "case.json", "/sets"), mesh_).at("s");
  }
  std::string problem(const json& set) const {
    return myotact::testing::complaint(ExitStatus::BadData, [&] { read(set); });
  }

  CaseMesh mesh_;
};

TEST_F(CaseSets, AreFoundByPlaneBoxNodesAndAttachment) {
  const NodeSet plane = read({{"plane", {{"axis", "x"}, {"value", 2}}}});
  EXPECT_THAT(plane.nodes, ElementsAre(8, 9, 10, 11));
  EXPECT_EQ(plane.plane_axis, 0);
  EXPECT_THAT(read({{"box", {0.5, -1, -1, 3, 0.5, 0.5}}}).nodes, ElementsAre(4, 8));
  EXPECT_THAT(read({{"nodes", {7, 3, 7}}}).nodes, ElementsAre(3, 7));
  mesh_.attachments.assign(12, -1);
  mesh_.attachments[5] = 2;
  EXPECT_THAT(read({{"attachment", 2}}).nodes, ElementsAre(5));
}

TEST_F(CaseSets, AllIsEveryNodeUnlessDefined) {
  EXPECT_EQ(read_sets(std::nullopt, mesh_).at("all").nodes.size(), 12U);
  const json sets = {{"all", {{"nodes", {1}}}}};
  EXPECT_THAT(read_sets(JsonValue(sets, "f"), mesh_).at("all").nodes, ElementsAre(1));
}

TEST_F(CaseSets, EmptyOnesTellHowFarTheNearestNodeIs) {
  EXPECT_THAT(
      problem({{"plane", {{"axis", "x"}, {"value", 2.25}, {"tolerance", 0.1}}}}),
      AllOf(HasSubstr("/sets/s/plane"), HasSubstr("the nearest node is 0.25 m away"), HasSubstr("at most 0.1")));
  EXPECT_THAT(problem({{"box", {5, 0, 0, 6, 1, 1}}}), HasSubstr("the nearest node is 3 m away"));
  EXPECT_THAT(problem({{"nodes", json::array()}}), HasSubstr("the set is empty"));
  EXPECT_THAT(problem({{"attachment", 3}}), HasSubstr("no point data \"attachment\""));
  mesh_.attachments.assign(12, 1);
  EXPECT_THAT(problem({{"attachment", 3}}), HasSubstr("no node has the attachment 3; the last one in use is 1"));
}

TEST_F(CaseSets, DefectsNameTheirPlace) {
  EXPECT_THAT(problem({{"plane", {{"axis", "w"}, {"value", 0}}}}), HasSubstr("must be one of x, y, z"));
  EXPECT_THAT(problem({{"box", {1, 0, 0, 0, 1, 1}}}),
              AllOf(HasSubstr("/sets/s/box/0"), HasSubstr("lower corner first")));
  EXPECT_THAT(problem({{"nodes", {12}}}), AllOf(HasSubstr("/sets/s/nodes/0: is 12"), HasSubstr("between 0 and 11")));
  EXPECT_THAT(problem(json::object()), HasSubstr("must hold one of plane, box, nodes and attachment"));
  EXPECT_THAT(problem({{"nodes", {1}}, {"attachment", 1}}), HasSubstr("not several"));
}

TEST_F(CaseSets, MidSidesFollowTheirCorners) {
  mesh_.mesh = geometry::make_quadratic(mesh_.mesh);
  const NodeSet edge = read({{"nodes", {0, 1}}});
  ASSERT_EQ(edge.nodes.size(), 3U);
  EXPECT_EQ(mesh_.mesh.nodes_m[static_cast<std::size_t>(edge.nodes[2])], Vec3(0, 0, 0.5));
}

TEST_F(CaseSets, TetsLieInASetOrTouchIt) {
  EXPECT_EQ(tets_of(read({{"box", {0, 0, 0, 1, 1, 1}}}), mesh_.mesh).size(), 6U);
  const auto touching = tets_of(read({{"plane", {{"axis", "x"}, {"value", 0}}}}), mesh_.mesh);
  EXPECT_EQ(touching.size(), 6U);
}

}  // namespace
}  // namespace myotact::measure
