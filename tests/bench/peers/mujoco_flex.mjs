// The bodies that peers_steps left in a folder, stepped by MuJoCo's flex (its WebAssembly build from npm), one thread.
// node mujoco_flex.mjs FOLDER MODULE-FOLDER BODY...: prints rows of the same table.

import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";

const [folder, modules, ...names] = process.argv.slice(2);
const load = (await import(pathToFileURL(`${modules}/node_modules/@mujoco/mujoco/mujoco.js`))).default;
const mujoco = await load();
const version = JSON.parse(readFileSync(`${modules}/node_modules/@mujoco/mujoco/package.json`)).version;

const median = (values) => [...values].sort((a, b) => a - b)[Math.floor(values.length / 2)];

function modelOf(body, dt) {
  const mass = body.mass_kg.reduce((a, b) => a + b, 0);
  return `<mujoco><option timestep="${dt}" gravity="0 -9.81 0" integrator="discrete"/><size memory="256M"/>
<worldbody><flexcomp name="body" type="direct" dim="3" mass="${mass}" radius="1e-4"
 point="${body.rest_m.join(" ")}" element="${body.tets.flat().join(" ")}">
<contact contype="0" conaffinity="0" selfcollide="none" internal="false"/>
<elasticity young="${body.young_Pa}" poisson="${body.poisson}" damping="0"/>
<pin id="${body.held.join(" ")}"/></flexcomp></worldbody></mujoco>`;
}

/// Every free node gets the mass that it has in the other programs; flexcomp shares it out evenly.
function shareMass(model, data, body) {
  const free = body.mass_kg.filter((_, n) => !body.held.includes(n));
  const bodies = model.body_mass.length;
  if (bodies < free.length) throw new Error(`${bodies} bodies for ${free.length} nodes`);
  for (let k = 0; k < free.length; ++k) {
    model.body_mass[bodies - free.length + k] = free[k];
  }
  mujoco.mj_setConst(model, data);
}

function step(body, dt) {
  const model = mujoco.MjModel.from_xml_string(modelOf(body, dt));
  const data = new mujoco.MjData(model);
  shareMass(model, data, body);
  const substeps = Math.round(0.01 / dt);
  const times = [];
  for (let k = 0; k < body.steps; ++k) {
    const begin = process.cpuUsage();
    for (let i = 0; i < substeps; ++i) mujoco.mj_step(model, data);
    const used = process.cpuUsage(begin);
    times.push(1e-3 * (used.user + used.system));
  }
  const x = Array.from(data.flexvert_xpos);
  model.delete();
  data.delete();
  return { times, x };
}

function row(body, dt) {
  const program = `MuJoCo ${version} flex (WebAssembly), ${Math.round(0.01 / dt)} x ${1e3 * dt} ms`;
  const { times, x } = step(body, dt);
  let gap = 0, way = 0;
  for (let n = 0; n < x.length; n += 3) {
    const between = (a, b) => Math.hypot(a[n] - b[n], a[n + 1] - b[n + 1], a[n + 2] - b[n + 2]);
    gap = Math.max(gap, between(x, body.right_m));
    way = Math.max(way, between(body.rest_m, body.right_m));
  }
  const tip = (1e3 * body.tip.reduce((sum, n) => sum + x[3 * n + 1] - body.rest_m[3 * n + 1], 0)) / body.tip.length;
  const truth = body.quadratic_mm ? (100 * (tip / body.quadratic_mm - 1)).toFixed(1) : "";
  const late = [...times].sort((a, b) => a - b)[Math.floor(times.length * 0.9)];
  return `| ${body.name} | ${program} | St. Venant-Kirchhoff | 1 | ${median(times).toFixed(2)} | ${late.toFixed(2)} | ` +
    `${((100 * gap) / way).toPrecision(2)} (to corotated) | ${tip.toFixed(2)} | ${truth} |`;
}

for (const name of names) {
  const body = JSON.parse(readFileSync(`${folder}/${name}.json`));
  for (const dt of [0.002, 0.01]) {
    try {
      console.log(row(body, dt));
    } catch (error) {
      console.log(`| ${body.name} | MuJoCo ${version} flex, ${1e3 * dt} ms | | 1 | | | ${error.message ?? error} | | |`);
    }
  }
}
