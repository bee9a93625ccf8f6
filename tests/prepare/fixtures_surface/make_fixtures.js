// Two slabs with two blocks between them that meet along an edge, by the surface nets of a foreign program (npm:
// isosurface): node make_fixtures.js > surface_nets.off
const { surfaceNets } = require('isosurface')

const step_m = 0.004
const size = [11, 9, 10]

function inside(x, y, z) {
  const [i, j, k] = [x, y, z].map(Math.round)
  const box = (x0, x1, y0, y1, z0, z1) => i >= x0 && i < x1 && j >= y0 && j < y1 && k >= z0 && k < z1
  return box(1, 9, 1, 7, 1, 3) || box(1, 5, 1, 4, 3, 6) || box(5, 9, 4, 7, 3, 6) || box(1, 9, 1, 7, 6, 8)
}

const mesh = surfaceNets(size, (x, y, z) => (inside(x, y, z) ? -1 : 1), [[0, 0, 0], size])
console.log('OFF\n# surfaceNets of isosurface 1.0.0 (npm, MIT) on 264 voxels of 4 mm; metres')
console.log(`${mesh.positions.length} ${mesh.cells.length} 0`)
for (const p of mesh.positions) console.log(p.map((v) => +(v * step_m).toFixed(5)).join(' '))
for (const c of mesh.cells) console.log('3 ' + c.join(' '))
