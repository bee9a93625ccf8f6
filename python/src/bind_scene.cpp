#include <memory>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "binding.h"
#include "gil.h"
#include "live_scene.h"
#include "specimen_handle.h"

namespace myotact::python {

namespace {

using Triple = std::array<double, 3>;
using SceneClass = py::class_<LiveScene, std::unique_ptr<LiveScene, LiveSceneDeleter>>;

void require_muscle(const LiveScene& live, int index) {
  require_index("muscle", index, live.scene().specimen.muscles.size());
}
void require_joint(const LiveScene& live, int index) {
  require_index("joint", index, live.scene().specimen.joints.size());
}
void require_tool(const LiveScene& live, int index) {
  require_index("tool", index, live.scene().tools.size());
}

/// Arrays follow whatever has become of the steps, also where one of them throws.
class Refreshed {
 public:
  explicit Refreshed(LiveScene& live) : live_(live) {}
  ~Refreshed() { live_.refresh(); }
  Refreshed(const Refreshed&) = delete;
  Refreshed& operator=(const Refreshed&) = delete;

 private:
  LiveScene& live_;
};

void step(LiveScene& live, long count) {
  const Turn turn(live.turns());
  const Refreshed refreshed(live);
  for (long i = 0; i < count; ++i) {
    {
      const WithoutGil free;
      live.step();
    }
    check_signals();
  }
}

std::unique_ptr<LiveScene, LiveSceneDeleter> make(const SceneChoice& choice) {
  using Made = std::unique_ptr<LiveScene, LiveSceneDeleter>;
  return watched([&](const auto&) { return Made(new LiveScene(choice)); });
}

py::array_t<double> array(LiveScene& live, int muscle, MuscleArray what) {
  require_muscle(live, muscle);
  const Turn turn(live.turns());
  const Numbers numbers = live.array(muscle, what);
  return view_of(numbers->data(), numbers->size() / 3, 3, numbers);
}

py::dict muscle_state(LiveScene& live, int muscle) {
  require_muscle(live, muscle);
  const Turn turn(live.turns());
  const simulation::Simulation& simulation = live.simulation();
  py::dict state;
  state["activation"] = simulation.activation(muscle);
  state["excitation"] = simulation.excitation(muscle);
  state["force"] = simulation.muscle_force_N(muscle);
  state["contact_force"] = simulation.contact_force_N(muscle);
  state["volume_ratio"] = simulation.volume_ratio(muscle);
  state["asleep"] = simulation.asleep(muscle);
  state["driven"] = live.is_driven(muscle);
  return state;
}

/// A copy: its number of points changes where the line wraps.
py::array_t<double> line(LiveScene& live, int muscle) {
  require_muscle(live, muscle);
  const Turn turn(live.turns());
  const auto points = std::make_shared<const std::vector<Vec3>>(live.simulation().line_world_m(muscle));
  return view_of(*points, points);
}

py::dict joint_state(LiveScene& live, int joint) {
  require_joint(live, joint);
  const Turn turn(live.turns());
  const simulation::JointReadout readout = live.simulation().joint(joint);
  py::dict state;
  state["q"] = readout.angle_rad;
  state["velocity"] = readout.velocity_rad_s;
  state["torque"] = readout.net_torque_Nm;
  state["own_torque"] = readout.own_torque_Nm;
  state["stiffness"] = readout.stiffness_Nm_rad;
  state["line_stiffness"] = readout.line_muscle_Nm_rad + readout.line_geometry_Nm_rad + readout.passive_Nm_rad;
  state["contact_stiffness"] = readout.contact_Nm_rad;
  state["passive_stiffness"] = readout.passive_Nm_rad;
  state["damping"] = readout.damping_Nms_rad;
  state["inertia"] = readout.inertia_kg_m2;
  return state;
}

double moment_arm(LiveScene& live, int muscle, int joint) {
  require_muscle(live, muscle);
  require_joint(live, joint);
  const Turn turn(live.turns());
  return live.simulation().muscle_at_joint(muscle, joint).moment_arm_m;
}

py::dict tool_state(LiveScene& live, int tool) {
  require_tool(live, tool);
  const Turn turn(live.turns());
  const messages::ToolState& now = live.tool(tool);
  const anatomy::Specimen& specimen = live.scene().specimen;
  py::list contacts;
  for (const TouchedPoint& point : live.touched(tool)) {
    contacts.append(py::make_tuple(point.part, point.triangle, tuple_of(point.point_m), tuple_of(point.normal)));
  }
  const auto name = [](const auto& list, int index) -> py::object {
    if (index < 0 || static_cast<std::size_t>(index) >= list.size()) return py::none();
    return py::cast(list[static_cast<std::size_t>(index)].key);
  };
  py::dict state;
  state["position"] = now.tool_position_world_m;
  state["proxy"] = now.proxy_position_world_m;
  state["force"] = now.force_world_N;
  state["faults"] = now.faults;
  state["contacts"] = contacts;
  state["line_in_hand"] = name(specimen.muscles, now.grabbed_line);
  state["body_in_hand"] = name(specimen.bodies, now.grabbed_body);
  return state;
}

py::list tool_facts(const LiveScene& live) {
  py::list all;
  for (const scene::ToolSettings& tool : live.scene().tools) {
    py::dict facts;
    facts["hand"] = tool.hand;
    facts["radius"] = tool.radius_m;
    facts["stiffness"] = tool.stiffness_N_m;
    all.append(facts);
  }
  return all;
}

py::dict scene_facts(const LiveScene& live) {
  const scene::Scene& scene = live.scene();
  py::dict facts;
  facts["name"] = scene.name;
  facts["title"] = scene.title;
  facts["note"] = scene.note;
  facts["dt"] = scene.settings.dt_s;
  facts["specimen_folder"] = scene.specimen_folder.string();
  facts["text"] = scene.source_text;
  facts["co_contraction_joint"] =
      scene.co_contraction ? py::cast(scene.specimen.joints[static_cast<std::size_t>(scene.co_contraction->joint)].key)
                           : py::object(py::none());
  return facts;
}

py::dict state(LiveScene& live) {
  const Turn turn(live.turns());
  const simulation::Simulation& simulation = live.simulation();
  py::dict state;
  state["time"] = simulation.time_s();
  state["hash"] = simulation.state_hash();
  state["failed_steps"] = simulation.failed_steps();
  state["residual"] = simulation.residual_share();
  state["notice"] = live.conductor().notice();
  state["script_end"] = live.conductor().script_end_s();
  return state;
}

void command(LiveScene& live, const messages::Order& order, double over_s) {
  const Turn turn(live.turns());
  live.command(order, over_s);
}

void begin(LiveScene& live, int tool, double duration_s, const scene::Action& action) {
  require_tool(live, tool);
  const Turn turn(live.turns());
  live.begin(tool, duration_s, action);
}

void bind_orders(SceneClass& scene) {
  scene
      .def("activate",
           [](LiveScene& live, int muscle, double to, double over_s) {
             require_muscle(live, muscle);
             command(live, messages::Activate{muscle, to}, over_s);
           })
      .def("set_levels",
           [](LiveScene& live, double flexors, double extensors, double over_s) {
             command(live, messages::SetLevels{flexors, extensors}, over_s);
           })
      .def("co_contract",
           [](LiveScene& live, double common, double difference, double over_s) {
             command(live, messages::CoContract{common, difference}, over_s);
           })
      .def("hold_posture", [](LiveScene& live, bool on) { command(live, messages::HoldPosture{on}, 0.0); })
      .def("set_gravity", [](LiveScene& live, bool on) { command(live, messages::SetGravity{on}, 0.0); })
      .def("push",
           [](LiveScene& live, int joint, double torque_Nm, double seconds) {
             require_joint(live, joint);
             command(live, messages::Shove{joint, torque_Nm}, seconds);
           })
      .def("lock",
           [](LiveScene& live, int joint, bool on) {
             require_joint(live, joint);
             const Turn turn(live.turns());
             live.simulation().set_joint_locked(joint, on);
           })
      .def("reset", [](LiveScene& live) {
        const Turn turn(live.turns());
        const Refreshed refreshed(live);
        const WithoutGil free;
        live.command(messages::Reset{}, 0.0);
      });
}

void bind_hand(SceneClass& scene) {
  scene
      .def("move", [](LiveScene& live, int tool, double seconds,
                      const Triple& to_m) { begin(live, tool, seconds, scene::MoveHand{to_vec3(to_m)}); })
      .def("touch",
           [](LiveScene& live, int tool, double seconds, int muscle, double place, const Triple& from, double depth_m) {
             require_muscle(live, muscle);
             begin(live, tool, seconds, scene::TouchMuscle{muscle, place, to_vec3(from), depth_m});
           })
      .def("slide",
           [](LiveScene& live, int tool, double seconds, double to, double depth_m) {
             begin(live, tool, seconds, scene::SlideOnMuscle{to, depth_m});
           })
      .def("grab_line",
           [](LiveScene& live, int tool, double seconds, int muscle, double place, const Triple& from,
              const Triple& drag_m) {
             require_muscle(live, muscle);
             begin(live, tool, seconds, scene::GrabLine{muscle, place, to_vec3(from), to_vec3(drag_m)});
           })
      .def("grab_bone",
           [](LiveScene& live, int tool, double seconds, int bone, const Triple& from, const Triple& drag_m) {
             require_index("bone", bone, live.scene().specimen.bones.size());
             begin(live, tool, seconds, scene::GrabBone{bone, to_vec3(from), to_vec3(drag_m)});
           })
      .def("release",
           [](LiveScene& live, int tool, double seconds) { begin(live, tool, seconds, scene::ReleaseHand{}); });
}

}  // namespace

void bind_scene(py::module_& module) {
  py::enum_<MuscleArray>(module, "MuscleArray")
      .value("nodes", MuscleArray::Nodes)
      .value("velocities", MuscleArray::NodeVelocities)
      .value("skin", MuscleArray::Skin);
  py::class_<SceneChoice>(module, "SceneChoice")
      .def(py::init<>())
      .def_readwrite("scene", &SceneChoice::scene)
      .def_readwrite("folder", &SceneChoice::folder)
      .def_readwrite("set", &SceneChoice::set)
      .def_readwrite("script", &SceneChoice::script)
      .def_readwrite("co_contraction", &SceneChoice::co_contraction)
      .def_readwrite("workers", &SceneChoice::workers)
      .def_readwrite("seed", &SceneChoice::seed)
      .def_readwrite("samples", &SceneChoice::samples);
  SceneClass scene(module, "LiveScene");
  scene.def(py::init(&make))
      .def("step", &step)
      .def("array", &array)
      .def("muscle_state", &muscle_state)
      .def("line", &line)
      .def("joint_state", &joint_state)
      .def("moment_arm", &moment_arm)
      .def("tool_state", &tool_state)
      .def("tool_facts", &tool_facts)
      .def("facts", &scene_facts)
      .def("state", &state)
      .def("specimen", [](const LiveScene& live) { return SpecimenHandle{live.specimen()}; })
      .def("samples_csv", [](LiveScene& live) {
        const Turn turn(live.turns());
        return live.samples_csv();
      });
  bind_orders(scene);
  bind_hand(scene);
}

}  // namespace myotact::python
