#include "view/look/part.h"

#include <gtest/gtest.h>

#include "support/synthetic_specimen.h"
#include "view/look/start_view.h"

namespace myotact::view {
namespace {

struct PartNames : ::testing::Test {
  PartNames() {
    specimen.bones[0].name_en = "Shoulder blade";
    specimen.bones[0].name_la = "Scapula";
    specimen.bones[1].name_en = specimen.bones[1].name_la = "Humerus";
    view = start_view(specimen, 1.0f);
  }
  anatomy::Specimen specimen = myotact::testing::antagonist_hinge();
  ViewState view;
  const Part blade{PartKind::Bone, 0}, humerus{PartKind::Bone, 1}, flexor{PartKind::Muscle, 0};
};

TEST_F(PartNames, AreAsAskedFor) {
  EXPECT_EQ(name_of(specimen, blade, NameStyle::English), "Shoulder blade");
  EXPECT_EQ(name_of(specimen, blade, NameStyle::Latin), "Scapula");
  EXPECT_EQ(name_of(specimen, blade, NameStyle::Both), "Shoulder blade (Scapula)");
  EXPECT_EQ(name_of(specimen, humerus, NameStyle::Both), "Humerus");
  EXPECT_EQ(name_of(specimen, flexor, NameStyle::Both), "flexor muscle (musculus flexor)");
  EXPECT_EQ(name_of(specimen, Part{}, NameStyle::Both), "");
  EXPECT_EQ(key_of(specimen, flexor), "flexor");
}

TEST_F(PartNames, OneThatIsMissingIsStoodInForByTheOther) {
  specimen.bones[0].name_en.clear();
  specimen.bones[1].name_la.clear();
  for (const NameStyle style : {NameStyle::English, NameStyle::Latin, NameStyle::Both}) {
    EXPECT_EQ(name_of(specimen, blade, style), "Scapula");
    EXPECT_EQ(name_of(specimen, humerus, style), "Humerus");
  }
}

TEST_F(PartNames, AreNotToldWhereTheyWouldBeTheAnswer) {
  view.names = NameStyle::Latin;
  EXPECT_EQ(name_of(specimen, blade, view), "Scapula");
  view.names_hidden = true;
  EXPECT_EQ(name_of(specimen, blade, view), "?");
}

}  // namespace
}  // namespace myotact::view
