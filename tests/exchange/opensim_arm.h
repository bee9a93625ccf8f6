#pragma once

#include <string>

// A made-up arm as an .osim file: a humerus welded to the ground, a forearm on a pin, a flexor and an extensor that
// goes round a cylinder.

namespace myotact::testing {

/// The text with every `from` in place of which `to` stands.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

inline std::string muscle_text(const std::string& type, const std::string& name, const std::string& x,
                               const std::string& wrap) {
  return "<" + type + " name=\"" + name +
         "\"><GeometryPath name=\"geometrypath\"><PathPointSet><objects>"
         "<PathPoint name=\"" +
         name +
         "-P1\"><socket_parent_frame>/bodyset/humerus</socket_parent_frame>"
         "<location>" +
         x +
         " -0.02 0.01</location></PathPoint>"
         "<PathPoint name=\"" +
         name +
         "-P2\"><socket_parent_frame>/bodyset/forearm</socket_parent_frame>"
         "<location>" +
         x + " -0.05 0</location></PathPoint></objects></PathPointSet>" +
         (wrap.empty()
              ? ""
              : "<PathWrapSet><objects><PathWrap name=\"w\"><wrap_object>" + wrap +
                    "</wrap_object><method>hybrid</method><range>-1 -1</range></PathWrap></objects></PathWrapSet>") +
         "</GeometryPath><max_isometric_force>600</max_isometric_force><optimal_fiber_length>0.12</"
         "optimal_fiber_length>"
         "<tendon_slack_length>0.2</tendon_slack_length><pennation_angle_at_optimal>0.1</pennation_angle_at_optimal>"
         "</" +
         type + ">";
}

inline std::string arm_text() {
  return R"(<?xml version="1.0" encoding="UTF-8" ?>
<OpenSimDocument Version="40000">
<Model name="arm">
<Ground name="ground"/>
<gravity>0 -9.8 0</gravity>
<BodySet name="bodyset"><objects>
<Body name="humerus"><mass>2</mass><mass_center>0 -0.15 0</mass_center><inertia>0.02 0.003 0.02 0 0 0</inertia>
<WrapObjectSet><objects><WrapCylinder name="olecranon"><translation>0 -0.3 0</translation>
<xyz_body_rotation>0 0 0</xyz_body_rotation><quadrant>-x</quadrant><radius>0.02</radius><length>0.1</length>
</WrapCylinder></objects></WrapObjectSet></Body>
<Body name="forearm"><mass>1.5</mass><mass_center>0 -0.1 0</mass_center><inertia>0.01 0.001 0.012 0 0 0</inertia></Body>
</objects></BodySet>
<JointSet name="jointset"><objects>
<WeldJoint name="shoulder"><socket_parent_frame>/ground</socket_parent_frame>
<socket_child_frame>/bodyset/humerus</socket_child_frame></WeldJoint>
<PinJoint name="elbow"><socket_parent_frame>humerus_offset</socket_parent_frame>
<socket_child_frame>/bodyset/forearm</socket_child_frame>
<coordinates><Coordinate name="elbow_flexion"><default_value>0.5</default_value><range>0 2.2</range></Coordinate></coordinates>
<frames><PhysicalOffsetFrame name="humerus_offset"><socket_parent>/bodyset/humerus</socket_parent>
<translation>0 -0.3 0</translation><orientation>0 0 0</orientation></PhysicalOffsetFrame></frames></PinJoint>
</objects></JointSet>
<ForceSet name="forceset"><objects>
)" + muscle_text("Millard2012EquilibriumMuscle", "biceps", "0.03", "") +
         muscle_text("Thelen2003Muscle", "triceps", "-0.025", "olecranon") +
         "\n</objects></ForceSet>\n</Model>\n</OpenSimDocument>\n";
}

}  // namespace myotact::testing
