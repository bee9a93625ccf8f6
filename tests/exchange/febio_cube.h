#pragma once

#include <string>

#include <fmt/format.h>

namespace myotact::testing {

/// A model of FEBio: a cube of 1 m as one hexahedron, x = 0, y = 0 and z = 0 held across, and what a test adds.
struct FebioCube {
  std::string material = R"(<material id="3" name="stuff" type="neo-Hookean"><E>1</E><v>0.3</v></material>)";
  std::string more_mesh, mesh_data, boundary, loads;
  std::string curve = "<pt>0,0</pt><pt>1,1</pt>";
  std::string elements = R"(<Elements type="hex8" name="cube"><elem id="9">11,12,13,14,15,16,17,18</elem></Elements>)";
  std::string version = "4.0", module = "solid", sections;

  std::string text() const {
    return fmt::format(
        R"(<?xml version="1.0"?>
<febio_spec version="{}"><Module type="{}"/>
<Control><analysis>STATIC</analysis><time_steps>10</time_steps><step_size>0.1</step_size></Control>
<Material>{}</Material>
<Mesh><Nodes name="nodes">
<node id="11">0,0,0</node><node id="12">1,0,0</node><node id="13">1,1,0</node><node id="14">0,1,0</node>
<node id="15">0,0,1</node><node id="16">1,0,1</node><node id="17">1,1,1</node><node id="18">0,1,1</node>
</Nodes>{}
<NodeSet name="x0">11, 14, 15, 18</NodeSet><NodeSet name="y0">11,12,15,16</NodeSet><NodeSet name="z0">11,12,13,14</NodeSet>
<NodeSet name="x1">
  12, 13,
  16, 17
</NodeSet>{}</Mesh>
<MeshDomains><SolidDomain name="cube" mat="stuff"/></MeshDomains><MeshData>{}</MeshData>
<Boundary><bc name="a" node_set="x0" type="zero displacement"><x_dof>1</x_dof><y_dof>0</y_dof><z_dof>0</z_dof></bc>
<bc name="b" node_set="y0" type="zero displacement"><x_dof>0</x_dof><y_dof>1</y_dof><z_dof>0</z_dof></bc>
<bc name="c" node_set="z0" type="zero displacement"><x_dof>0</x_dof><y_dof>0</y_dof><z_dof>1</z_dof></bc>{}</Boundary>
<Loads>{}</Loads>
<LoadData><load_controller id="1" type="loadcurve"><interpolate>LINEAR</interpolate><points>{}</points></load_controller></LoadData>
<Output><plotfile type="febio"/></Output>{}
</febio_spec>)",
        version, module, material, elements, more_mesh, mesh_data, boundary, loads, curve, sections);
  }
};

}  // namespace myotact::testing
