import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Part } from '../src/app/facts';
import { plainLook } from '../src/app/look';
import { Beat, Glide } from '../src/limb/glide';
import { placeLabels, spread } from '../src/limb/label_layout';
import { LimbModel } from '../src/limb/model';
import { closestOnTriangle, nearest, raycast, weighted } from '../src/limb/picking';
import { isAtWork } from '../src/limb/tools_drawing';
import { isSolid, solidity } from '../src/limb/visibility';
import type { ToolReading } from '../src/wire/moment';
import { Press, RADIUS_M, STIFFNESS_N_M } from '../src/touch/press';
import { nearestOnLine, pointOnLine } from '../src/touch/pull';
import { distance, type Point } from '../src/limb/vectors';

const muscle = { kind: 'muscle', key: 'm', index: 0, surface: 0, layer: 'deep', group: 'flexor' } as Part;
const bone = { kind: 'bone', key: 'b', index: 0, surface: 1 } as Part;

/** A square of 0.2 m at a height, seen from above. */
function square(height: number): Float32Array {
  return Float32Array.of(-0.1, -0.1, height, 0.1, -0.1, height, 0.1, 0.1, height, -0.1, 0.1, height);
}

const twoTriangles = Uint32Array.of(0, 1, 2, 0, 2, 3);

/** The bone a decimetre below the skin. */
const poses = [Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -0.1)];

function limb(): LimbModel {
  const model = new LimbModel([muscle, bone]);
  const mesh = { positions_m: square(0), triangles: twoTriangles };
  model.takeMesh({ kind: 'skin', index: 0, body: -1, ...mesh });
  model.takeMesh({ kind: 'bone', index: 0, body: 0, ...mesh });
  const moment = { sequence: 1, time_s: 0, readings: null, inForce: null };
  model.takePicture({ ...moment, skins: new Map([[0, square(0.05)]]), poses }, 0);
  return model;
}

const all = (): boolean => true;

test('a picture is reached without a jump, whenever the next one comes', () => {
  const glide = new Glide(Float32Array.of(0));
  glide.aim(Float32Array.of(1));
  glide.step(0.5);
  assert.equal(glide.drawn[0], 0.5);
  glide.aim(Float32Array.of(2));
  glide.step(0);
  assert.equal(glide.drawn[0], 0.5);
  glide.step(1);
  assert.equal(glide.drawn[0], 2);
  assert.equal(glide.step(1), false);
});

test('what trembles stands still, and a slow drift is followed', () => {
  const glide = new Glide(Float32Array.of(0), 0.1);
  glide.aim(Float32Array.of(0.06));
  assert.equal(glide.step(1), false);
  glide.aim(Float32Array.of(0.12));
  assert.equal(glide.step(1), true);
  assert.equal(glide.drawn[0], Math.fround(0.12));
});

test('a way that no picture changed goes on from where it is drawn', () => {
  const glide = new Glide(Float32Array.of(0));
  glide.aim(Float32Array.of(1));
  glide.step(0.6);
  glide.begin();
  glide.aim(Float32Array.of(1));
  glide.step(0);
  assert.equal(glide.drawn[0], Math.fround(0.6));
  glide.step(1);
  assert.equal(glide.drawn[0], 1);
});

test('the beat of pictures is learnt and does not stretch over a pause', () => {
  const beat = new Beat();
  for (let time_ms = 0; time_ms <= 4000; time_ms += 50) beat.come(time_ms);
  assert.ok(Math.abs(beat.share(4025) - 0.5) < 0.02);
  beat.come(9000);
  assert.ok(Math.abs(beat.share(9025) - 0.5) < 0.02);
  assert.equal(beat.share(20000), 1);
});

test('a skin is drawn where its first picture has it, then on its way to the next', () => {
  const model = limb();
  assert.equal(model.surfaces[0]!.drawn_m[2], Math.fround(0.05));
  const next = { sequence: 2, time_s: 0, poses, readings: null, inForce: null };
  model.takePicture({ ...next, skins: new Map([[0, square(0.06)]]) }, 33);
  const { moved } = model.advance(33);
  assert.equal(moved.length, 1);
  assert.equal(model.surfaces[0]!.drawn_m[2], Math.fround(0.05));
  model.advance(200);
  assert.equal(model.surfaces[0]!.drawn_m[2], Math.fround(0.06));
  assert.equal(model.advance(210).moved.length, 0);
});

test('a ray hits the nearer part from outside only', () => {
  const model = limb();
  const down = { origin_m: [0.02, 0.01, 1] as Point, direction: [0, 0, -1] as Point };
  const hit = raycast(model, down, all);
  assert.equal(hit?.surface.part.key, 'm');
  assert.ok(distance(hit!.point_m, [0.02, 0.01, 0.05]) < 1e-7);
  assert.deepEqual(hit!.normal, [0, 0, 1]);
  const below = raycast(model, down, ({ part }) => part.kind === 'bone');
  assert.ok(distance(below!.point_m, [0.02, 0.01, -0.1]) < 1e-7);
  assert.equal(raycast(model, { origin_m: [0, 0, -1], direction: [0, 0, 1] }, all), null);
  assert.equal(raycast(model, { origin_m: [1, 0, 1], direction: [0, 0, -1] }, all), null);
});

test('the nearest place of a triangle is nearer than any other', () => {
  const corners: [Point, Point, Point] = [
    [0, 0, 0],
    [1, 0, 0],
    [0.2, 0.8, 0.3],
  ];
  for (const place of [
    [0.3, 0.3, 1],
    [-1, -1, 0],
    [2, 0.1, 0],
    [0.2, 2, 0],
    [0.5, -1, 0.2],
    [0.9, 0.9, 0],
  ] as Point[]) {
    const weights = closestOnTriangle(place, corners);
    assert.ok(Math.min(...weights) >= 0 && Math.abs(weights[0] + weights[1] + weights[2] - 1) < 1e-12);
    const best = distance(place, weighted(corners, weights));
    for (let i = 0; i <= 20; ++i) {
      for (let j = 0; i + j <= 20; ++j) {
        const other = weighted(corners, [1 - (i + j) / 20, i / 20, j / 20]);
        assert.ok(best <= distance(place, other) + 1e-12);
      }
    }
  }
});

test('the nearest place of the limb is of a side that faces the hand, within reach', () => {
  const model = limb();
  const search = { place_m: [0, 0, 0.04] as Point, reach_m: 0.02, facing: [0, 0, 1] as Point };
  const hit = nearest(model, search, all);
  assert.equal(hit?.surface.part.key, 'm');
  assert.ok(Math.abs(hit!.distance_m - 0.01) < 1e-7);
  assert.equal(nearest(model, { ...search, facing: [0, 0, -1] }, all), null);
  assert.equal(nearest(model, { ...search, reach_m: 0.005 }, all), null);
});

test('a press couples the ball to the place under it, the deeper the stronger', () => {
  const model = limb();
  const ray = { origin_m: [0, 0, 1] as Point, direction: [0, 0, -1] as Point };
  const press = new Press(model, raycast(model, ray, all)!, all);
  press.advance(0.006, 0.1);
  assert.ok(Math.abs(press.depth - 0.002) < 1e-12);
  for (let i = 0; i < 10; ++i) press.advance(0.006, 0.1);
  const { tool_m, proxy_m, force_N, contact } = press.feel();
  assert.ok(distance(tool_m, [0, 0, 0.05 + RADIUS_M - 0.006]) < 1e-7);
  assert.ok(distance(proxy_m, [0, 0, 0.05 + RADIUS_M]) < 1e-7);
  assert.ok(Math.abs(force_N[2] - 0.006 * STIFFNESS_N_M) < 1e-4);
  assert.equal(contact?.surface, 0);
  assert.ok(distance(contact!.target_m, [0, 0, 0.044]) < 1e-7);
  assert.equal(contact!.barycentric[0] + contact!.barycentric[1] + contact!.barycentric[2], 1);
});

test('a stroke keeps its depth below the limb as it was, and ends beside it', () => {
  const model = limb();
  const ray = (x: number) => ({ origin_m: [x, 0, 1] as Point, direction: [0, 0, -1] as Point });
  const press = new Press(model, raycast(model, ray(0), all)!, all);
  for (let i = 0; i < 10; ++i) press.advance(0.004, 0.1);
  const dented = { sequence: 2, time_s: 0, poses, readings: null, inForce: null };
  model.takePicture({ ...dented, skins: new Map([[0, square(0.048)]]) }, 33);
  press.strokeTo(ray(0.03));
  const felt = press.feel();
  assert.ok(distance(felt.tool_m, [0.03, 0, 0.05 + RADIUS_M - 0.004]) < 1e-7);
  assert.ok(Math.abs(felt.force_N[2] - 0.002 * STIFFNESS_N_M) < 1e-4);
  press.strokeTo(ray(0.5));
  assert.equal(press.feel().contact, null);
});

test('a place on a line is told by its share of the arc', () => {
  const line = [0, 0, 0, 1, 0, 0, 1, 3, 0];
  const found = nearestOnLine(line, [1.2, 1, 0]);
  assert.deepEqual(found, { fraction: 0.5, point_m: [1, 1, 0] });
  assert.deepEqual(pointOnLine(line, 0.5), [1, 1, 0]);
  assert.equal(nearestOnLine([0, 0, 0], [1, 1, 1]), null);
});

test('labels keep their order and distance, and stay in the picture', () => {
  assert.deepEqual(spread([10, 100], 20, 0, 200), [10, 100]);
  assert.deepEqual(spread([50, 50, 50], 20, 0, 200), [30, 50, 70]);
  assert.deepEqual(spread([195, 199], 20, 0, 200), [180, 200]);
  const placed = placeLabels(
    [
      { x: 0, y: 5, width: 9 },
      { x: 9, y: 5, width: 9 },
    ],
    100,
    20,
  );
  assert.deepEqual(
    placed.map((each) => each?.side),
    ['left', 'right'],
  );
});

test('the look says how solid a part is', () => {
  const look = plainLook();
  assert.equal(solidity(muscle, look), 1);
  assert.equal(solidity(muscle, { ...look, parts: { m: 'hidden' } }), 0);
  assert.equal(solidity(muscle, { ...look, only: ['b'] }), 0);
  assert.equal(solidity(muscle, { ...look, layers: { ...look.layers, deep: 0.4 } }), 0.4);
  assert.equal(isSolid(muscle, { ...look, parts: { m: 'faded' } }), false);
  assert.equal(isSolid(bone, { ...look, only: ['b'] }), true);
});

test('a hand that nobody has, or that does nothing, is not drawn', () => {
  const tool = { in_contact: false, line: -1 } as ToolReading;
  assert.ok(!isAtWork(tool));
  assert.ok(isAtWork({ ...tool, in_contact: true }));
  assert.ok(isAtWork({ ...tool, line: 0 }));
});
