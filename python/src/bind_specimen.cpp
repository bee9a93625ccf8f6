#include <memory>
#include <string>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "anatomy/specimen.h"
#include "arrays.h"
#include "binding.h"
#include "gil.h"
#include "specimen_handle.h"

namespace myotact::python {

namespace {

const anatomy::Muscle& muscle_of(const SpecimenHandle& handle, int index) {
  require_index("muscle", index, handle.specimen->muscles.size());
  return handle.specimen->muscles[static_cast<std::size_t>(index)];
}

const anatomy::Bone& bone_of(const SpecimenHandle& handle, int index) {
  require_index("bone", index, handle.specimen->bones.size());
  return handle.specimen->bones[static_cast<std::size_t>(index)];
}

py::dict facts_of(const anatomy::Specimen& specimen) {
  py::dict facts;
  facts["name"] = specimen.name;
  facts["species"] = specimen.species;
  facts["breed"] = specimen.breed;
  facts["side"] = specimen.side;
  facts["source"] = specimen.source;
  facts["licence"] = specimen.licence;
  facts["created_by"] = specimen.created_by;
  return facts;
}

py::list muscle_facts(const anatomy::Specimen& specimen) {
  py::list all;
  for (const anatomy::Muscle& muscle : specimen.muscles) {
    py::dict facts;
    facts["key"] = muscle.key;
    facts["name_la"] = muscle.name_la;
    facts["name_en"] = muscle.name_en;
    facts["peak_force"] = muscle.peak_force_N;
    facts["optimal_fibre"] = muscle.optimal_fibre_m;
    facts["pennation"] = muscle.pennation_rad;
    facts["rest_stretch"] = muscle.rest_stretch;
    facts["tendon_slack"] = muscle.tendon_slack_m;
    facts["estimated"] = muscle.estimated;
    all.append(facts);
  }
  return all;
}

py::list bone_facts(const anatomy::Specimen& specimen) {
  py::list all;
  for (const anatomy::Bone& bone : specimen.bones) {
    py::dict facts;
    facts["key"] = bone.key;
    facts["name_la"] = bone.name_la;
    facts["name_en"] = bone.name_en;
    facts["body"] = specimen.bodies[static_cast<std::size_t>(bone.body)].key;
    all.append(facts);
  }
  return all;
}

const char* name_of(anatomy::JointType type) {
  switch (type) {
    case anatomy::JointType::Hinge:
      return "hinge";
    case anatomy::JointType::Universal:
      return "universal";
    case anatomy::JointType::Ball:
      return "ball";
    case anatomy::JointType::Weld:
      return "weld";
  }
  return "";
}

py::list joint_facts(const anatomy::Specimen& specimen) {
  py::list all;
  for (const anatomy::Joint& joint : specimen.joints) {
    py::list axes;
    for (const Vec3& axis : joint.axes) axes.append(tuple_of(axis));
    py::dict facts;
    facts["key"] = joint.key;
    facts["type"] = name_of(joint.type);
    facts["parent"] = specimen.bodies[static_cast<std::size_t>(joint.parent)].key;
    facts["child"] = specimen.bodies[static_cast<std::size_t>(joint.child)].key;
    facts["centre"] = tuple_of(joint.centre_m);
    facts["axes"] = axes;
    facts["range"] = joint.range_rad;
    facts["passive_stiffness"] = joint.stiffness_Nm_rad;
    all.append(facts);
  }
  return all;
}

}  // namespace

void bind_specimen(py::module_& module) {
  py::class_<SpecimenHandle>(module, "Specimen")
      .def(py::init([](const std::string& folder) {
             return SpecimenHandle{watched([&](const auto&) {
               return std::make_shared<const anatomy::Specimen>(anatomy::load_specimen(folder));
             })};
           }),
           py::arg("folder"))
      .def("facts", [](const SpecimenHandle& h) { return facts_of(*h.specimen); })
      .def("muscles", [](const SpecimenHandle& h) { return muscle_facts(*h.specimen); })
      .def("bones", [](const SpecimenHandle& h) { return bone_facts(*h.specimen); })
      .def("joints", [](const SpecimenHandle& h) { return joint_facts(*h.specimen); })
      .def("nodes", [](const SpecimenHandle& h, int m) { return view_of(muscle_of(h, m).tets.nodes_m, h.specimen); })
      .def("tets", [](const SpecimenHandle& h, int m) { return view_of(muscle_of(h, m).tets.corners, h.specimen); })
      .def("fibres", [](const SpecimenHandle& h, int m) { return view_of(muscle_of(h, m).fibres, h.specimen); })
      .def("skin", [](const SpecimenHandle& h, int m) { return view_of(muscle_of(h, m).skin.positions_m, h.specimen); })
      .def("skin_triangles",
           [](const SpecimenHandle& h, int m) { return view_of(muscle_of(h, m).skin.triangles, h.specimen); })
      .def("bone_vertices",
           [](const SpecimenHandle& h, int b) { return view_of(bone_of(h, b).surface.positions_m, h.specimen); })
      .def("bone_triangles",
           [](const SpecimenHandle& h, int b) { return view_of(bone_of(h, b).surface.triangles, h.specimen); });
}

}  // namespace myotact::python
