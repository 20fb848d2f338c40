// Drives the page of `adslam replay` in headless Chromium as its user would.
// node browser.mjs CHROMIUM ONE_RUN.html TWO_RUNS.html EXPECTED.json; the exit code says whether all
// is well. EXPECTED holds what Rust says of step 9 of each page's first run.

import { strict as assert } from "node:assert";
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { inflateSync } from "node:zlib";
import { Browser } from "./chromium.mjs";

const [executable, one, two, expectedFile] = process.argv.slice(2);
const expected = JSON.parse(readFileSync(expectedFile, "utf8"));
const state = (page) => page.evaluate("window.adslam.state()");
const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

/** Compares what is drawn of the first run with what Rust says; the page has to be at step 9. */
async function compare(page, { robot, vertices, covariances, candidates }) {
  const close = (a, b, by, what) => {
    assert.equal(a.length, b.length, `number of ${what}`);
    const off = Math.max(0, ...a.map((x, i) => Math.abs(x - b[i])));
    assert.ok(off <= by, `${what} are off by ${off}`);
  };
  const drawn = await page.evaluate("window.adslam.drawn(0)");
  close((await state(page)).runs[0].robot, robot, 1e-9, "coordinates of the robot");
  close(drawn.vertices, vertices, 1e-4, "coordinates of the surface");
  // The unit sphere becomes M Mᵀ = 9 P at 3σ.
  const squares = covariances.flatMap((_, k) => {
    const m = (row, column) => drawn.ellipsoids[16 * k + 4 * column + row];
    const entry = (i, j) => [0, 1, 2].reduce((sum, c) => sum + m(i, c) * m(j, c), 0) / 9;
    return [entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)];
  });
  close(squares, covariances.flat(), 1e-6, "entries of the ellipsoids");
  // Where an arrow stands, and its x axis, which is where it looks.
  const arrows = candidates.flatMap((_, k) => {
    const at = 16 * k;
    return [...drawn.arrows.slice(at + 12, at + 15), ...drawn.arrows.slice(at, at + 3)];
  });
  assert.equal(drawn.arrows.length, 16 * candidates.length, "number of candidates");
  close(arrows, candidates.flat(), 1e-4, "candidates");
}

/** Sets a slider as a user's drag does. */
const slide = async (page, id, value) => {
  const set = `const s = document.getElementById("${id}"); s.value = ${value};`;
  await page.evaluate(`{ ${set} s.dispatchEvent(new Event("input", { bubbles: true })); }`);
  await page.frames(2);
};

/** Where an element is on the screen. */
const box = (page, selector) =>
  page.evaluate(`(({ x, y, width, height }) => ({ x, y, width, height }))(
    document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect())`);

const click = async (page, selector, across = 0.5) => {
  const { x, y, width, height } = await box(page, selector);
  await page.mouse("mousePressed", x + across * width, y + height / 2, 1);
  await page.mouse("mouseReleased", x + across * width, y + height / 2);
  await page.frames(2);
};

/** The pixels of a PNG without interlacing, and how many bytes one takes. */
function pixels(base64) {
  const png = Buffer.from(base64, "base64");
  const width = png.readUInt32BE(16);
  const bytes = png[25] === 6 ? 4 : 3;
  const parts = [];
  for (let at = 8; at < png.length; at += 12 + png.readUInt32BE(at)) {
    const length = png.readUInt32BE(at);
    if (png.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(png.subarray(at + 8, at + 8 + length));
  }
  const raw = inflateSync(Buffer.concat(parts));
  const stride = width * bytes;
  const rows = [];
  let above = Buffer.alloc(stride);
  for (let at = 0; at < raw.length; at += stride + 1) {
    const row = Buffer.from(raw.subarray(at + 1, at + 1 + stride));
    for (let i = 0; i < stride; i++) {
      const [a, b, c] = [row[i - bytes] ?? 0, above[i], above[i - bytes] ?? 0];
      const guess = a + b - c;
      const [pa, pb, pc] = [guess - a, guess - b, guess - c].map(Math.abs);
      const paeth = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
      row[i] += [0, a, b, (a + b) >> 1, paeth][raw[at]];
    }
    rows.push(row);
    above = row;
  }
  return { rows, bytes };
}

/** The variance of the brightness in a part of the screen. */
async function variance(page, { x, y, width, height }) {
  const { rows, bytes } = pixels(await page.screenshot());
  let [count, sum, squares] = [0, 0, 0];
  for (const row of rows.slice(y, y + height)) {
    for (let i = Math.round(x) * bytes; i < (x + width) * bytes; i += bytes) {
      count++;
      sum += row[i + 1];
      squares += row[i + 1] ** 2;
    }
  }
  return squares / count - (sum / count) ** 2;
}

async function oneRun(page) {
  await page.go(`${pathToFileURL(one)}#theme=light`);
  const first = await state(page);
  assert.equal(first.step, 1);
  assert.equal(first.runs.length, 1);
  assert.equal(await page.evaluate("document.querySelectorAll('.chart').length"), 6);

  // The slider moves the robot to where the history says that it is.
  await slide(page, "step", 9);
  const ninth = await state(page);
  assert.equal(ninth.step, 9);
  assert.ok(distance(ninth.runs[0].robot, first.runs[0].robot) > 0.1, "the robot has moved");
  assert.ok(ninth.runs[0].candidates > 0, "actions were scored");
  await compare(page, expected.one);

  // The scene is more than its background.
  const view = { x: 250, y: 150, width: 500, height: 400 };
  const drawn = await variance(page, view);
  assert.ok(drawn > 50, `the picture is empty: variance ${drawn}`);

  // Layers by box and by key; without any the scene is empty.
  await click(page, '[data-layer="surface"]');
  assert.equal((await state(page)).layers.surface, false);
  await page.key("1", "Digit1");
  assert.equal((await state(page)).layers.surface, true);
  for (const key of "134567890cg") await page.key(key);
  assert.deepEqual(Object.values((await state(page)).layers), Array(12).fill(false));
  const bare = await variance(page, view);
  assert.ok(bare < drawn / 10, `hidden layers are still drawn: variance ${bare} of ${drawn}`);
  for (const key of "134567890cg") await page.key(key);

  // The keyboard goes through the steps.
  await page.key("ArrowRight");
  assert.equal((await state(page)).step, 10);
  await page.key("ArrowLeft");
  await page.key("Home");
  assert.equal((await state(page)).step, 1);
  await page.key("End");
  assert.equal((await state(page)).step, first.steps);
  await page.key("Home");
  await page.key("+");
  assert.equal((await state(page)).speed, 10);
  await page.key(" ", "Space");
  assert.equal((await state(page)).playing, true);
  await page.evaluate("new Promise((done) => setTimeout(done, 700))");
  await page.key(" ", "Space");
  const played = await state(page);
  assert.ok(!played.playing && played.step > 3, `played to ${played.step}`);

  // The help opens and closes; the theme changes; a curve seeks; the views look elsewhere.
  const open = () => page.evaluate("document.getElementById('help').open");
  await page.key("?");
  assert.equal(await open(), true);
  await page.key("?");
  assert.equal(await open(), false);
  await page.key("t");
  assert.equal((await state(page)).theme, "dark");
  await click(page, '[data-curve="nees"] canvas', 0.96);
  assert.ok((await state(page)).step >= first.steps - 1, "a click at the right end of a curve");
  const cameras = new Set();
  for (const key of "ixyzf") {
    await page.key(key);
    cameras.add((await state(page)).runs[0].camera.map((x) => x.toFixed(2)).join());
  }
  assert.equal(cameras.size, 5);

  // Following, the camera goes where the robot goes.
  await page.key("Home");
  const followed = await state(page);
  assert.ok(distance(followed.runs[0].target, followed.runs[0].robot) < 1e-6);
  for (const [width, height] of [[1000, 640], [1900, 1000]]) {
    await page.resize(width, height);
    await page.frames(2);
    const wide = await page.evaluate("document.documentElement.scrollWidth");
    assert.ok(wide <= width, `${wide} px of content in ${width} px`);
  }
  await page.resize(1200, 750);
}

async function twoRuns(page) {
  await page.go(`${pathToFileURL(two)}#theme=dark&step=4`);
  const before = await state(page);
  assert.equal(before.runs.length, 2);
  assert.notEqual(before.runs[0].planner, before.runs[1].planner);
  assert.equal(before.step, 4);
  for (const x of [150, 580]) {
    const drawn = await variance(page, { x, y: 250, width: 200, height: 250 });
    assert.ok(drawn > 50, `one of the pictures is empty: variance ${drawn}`);
  }
  await slide(page, "step", 9);
  await compare(page, expected.two);
  await slide(page, "step", 4);
  // Turning one turns the other as far.
  await page.mouse("mousePressed", 700, 600, 1);
  await page.mouse("mouseMoved", 760, 570, 1);
  await page.mouse("mouseReleased", 760, 570);
  await page.frames(2);
  const after = await state(page);
  const turned = after.runs.map((run, i) => distance(run.camera, before.runs[i].camera));
  assert.ok(turned.every((by) => by > 0.1), `cameras moved by ${turned}`);
  const [a, b] = after.runs;
  const offset = (run) => run.camera.map((x, i) => x - run.target[i]);
  assert.ok(distance(offset(a), offset(b)) < 1e-6, "both look the same way");
  // Both go on together.
  await page.key("End");
  const end = await state(page);
  assert.equal(end.step, end.steps);
  for (const i of [0, 1]) assert.ok(distance(end.runs[i].robot, before.runs[i].robot) > 0.1);
}

const browser = new Browser(executable);
let failed = false;
try {
  const page = await browser.open(1200, 750);
  for (const check of [oneRun, twoRuns]) {
    await check(page);
    assert.deepEqual(page.errors, [], "errors in the console");
    console.log(`${check.name}: ok`);
  }
} catch (error) {
  console.error(error);
  failed = true;
} finally {
  await browser.close();
}
process.exit(failed ? 1 : 0);
