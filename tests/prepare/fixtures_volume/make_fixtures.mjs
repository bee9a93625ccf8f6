// Writes the phantom with ITK (npm: @itk-wasm/image-io): node make_fixtures.mjs FOLDER, where FOLDER holds what
// "make_fixtures.py --raw FOLDER" left.
import { readFileSync } from 'node:fs'
import { dirname, join } from 'node:path'
import { fileURLToPath } from 'node:url'
import { writeImageNode } from '@itk-wasm/image-io'

const here = dirname(fileURLToPath(import.meta.url))
const arrays = { uint8: Uint8Array, uint16: Uint16Array, int16: Int16Array, uint32: Uint32Array }

async function write(name, grid, componentType, useCompression) {
  const about = JSON.parse(readFileSync(join(process.argv[2], grid + '.json')))
  const image = {
    imageType: { dimension: 3, componentType, pixelType: 'Scalar', components: 1 },
    name: 'phantom',
    origin: about.origin,
    spacing: about.spacing,
    direction: Float64Array.from(about.direction),
    size: about.size,
    metadata: new Map(),
    data: arrays[componentType].from(about.labels),
  }
  await writeImageNode(image, join(here, name), { useCompression })
}

await write('itk_oblique.mha', 'oblique', 'uint8', true)
await write('itk_sagittal.mha', 'sagittal', 'uint16', false)
await write('itk_oblique.nii.gz', 'oblique', 'int16', true)
await write('itk_sagittal.nrrd', 'sagittal', 'uint8', true)
