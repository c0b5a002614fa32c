// check.js CHROMIUM URL DETECTIONS TARGETS RUN FLIGHT SCREENSHOTS: the page in a real browser, over a stack that flies.
//   DETECTIONS   what another listener heard on DETECTIONS (live_flight.cpp)
//   TARGETS      what it heard on TARGETS
//   RUN          the run folder of supervisor, whose processes are killed
//   FLIGHT       name of a flight on the disk
//   SCREENSHOTS  folder for them
'use strict';
const {spawnSync} = require('child_process');
const fs = require('fs');
const path = require('path');
const {Browser} = require('./browser.js');
const {goesOnWithoutDisk} = require('./slow_disk.js');
const {tenViewers} = require('./viewers.js');
const [chromium, url, detections_file, targets_file, run, flight, screenshots] = process.argv.slice(2);

const assert = (is_true, what) => { if (!is_true) throw new Error(what); };
// Its exit status says whether all run, which the recorder does not.
const supervisor = (...words) => spawnSync('supervisorctl', ['-c', 'supervisord.conf', ...words], {cwd: run}).stdout.toString().trim();
const heard = (file) => new Map(fs.readFileSync(file, 'utf8').split('\n').slice(0, -1).map((line) => {
  const {utime, ...content} = JSON.parse(line);
  return [utime, content];
}));

/** What was heard, when it is no longer behind the page, which has shown these times. */
async function heardAll(file, utimes) {
  for (let i = 0; i < 200 && !utimes.every((utime) => heard(file).has(utime)); ++i) await new Promise((done) => setTimeout(done, 50));
  return heard(file);
}

/** In the page: after each frame that is drawn, keeps its time and where the layer of the boxes is painted. */
const kWatch = `(() => {
  window.seen = new Map();
  const view = document.getElementById('view');
  const canvas = document.getElementById('boxes');
  new MutationObserver(() => {
    const pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
    const painted = [];
    for (let i = 3; i < pixels.length; i += 4) if (pixels[i] > 0) painted.push((i - 3) / 4);
    window.seen.set(Number(view.dataset.utime), painted);
  }).observe(view, {attributes: true, attributeFilter: ['data-utime']});
})()`;

/** The pixels that boxes must paint (all of those that are seen) and may paint. */
function outlines(boxes, line, width, height) {
  const must = new Set();
  const may = new Set();
  for (const [, x, y, w, h, seen] of boxes) {
    const thick = Math.max(1, Math.min(line, Math.floor(w / 2), Math.floor(h / 2)));
    for (let v = Math.max(0, y); v < Math.min(height, y + h); ++v) {
      for (let u = Math.max(0, x); u < Math.min(width, x + w); ++u) {
        const depth = Math.min(u - x, x + w - 1 - u, v - y, y + h - 1 - v);
        if (depth >= thick) continue;
        may.add(v * width + u);
        if (seen) must.add(v * width + u);
      }
    }
  }
  return {must, may};
}

async function compareWithDetections(page) {
  await page.value(kWatch);
  await page.until('frames with boxes', '[...window.seen.values()].filter((painted) => painted.length > 0).length >= 40');
  const {seen, width, height, line} = await page.value(`(() => {
    const canvas = document.getElementById('boxes');
    const line = Math.max(1, Math.round(2 * canvas.width / canvas.clientWidth));
    return {seen: [...window.seen], width: canvas.width, height: canvas.height, line};
  })()`);
  const said = await heardAll(detections_file, seen.map(([utime]) => utime));
  let boxes_seen = 0;
  for (const [utime, painted] of seen) {
    assert(said.has(utime), `the page shows a frame (${utime}) of which DETECTIONS says nothing`);
    const {must, may} = outlines(said.get(utime).boxes, line, width, height);
    const drawn = new Set(painted);
    for (const pixel of must) assert(drawn.has(pixel), `${utime}: pixel ${pixel % width}, ${Math.floor(pixel / width)} of a box is not drawn`);
    for (const pixel of drawn) assert(may.has(pixel), `${utime}: pixel ${pixel % width}, ${Math.floor(pixel / width)} is drawn, but no box is there`);
    boxes_seen += said.get(utime).boxes.length;
  }
  const places = await page.value(`['image', 'mask', 'trails', 'boxes', 'names'].map((id) => {
    const box = document.getElementById(id).getBoundingClientRect();
    return [box.x, box.y, box.width, box.height, document.getElementById(id).width].join();
  })`);
  assert(new Set(places).size === 1, `the layers do not lie over each other: ${places}`);
  console.log(`boxes: ${boxes_seen} in ${seen.length} frames are those of DETECTIONS, to the pixel`);
}

/** In the page: each map that is drawn, its rows, and how opaque the canvas is where each target is. */
const kWatchMap = `(() => {
  window.maps = new Map();
  const canvas = document.getElementById('map');
  const ratio = window.devicePixelRatio;
  new MutationObserver(() => {
    const {utime, east, north, scale} = canvas.dataset;
    const context = canvas.getContext('2d');
    window.maps.set(Number(utime), [...document.querySelectorAll('#targets tbody tr')].map(({dataset}) => {
      const x = canvas.clientWidth / 2 + (dataset.east - east) * scale;
      const y = canvas.clientHeight / 2 - (dataset.north - north) * scale;
      const alpha = context.getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data[3];
      return {...dataset, alpha, is_on: x > 2 && y > 2 && x < canvas.clientWidth - 2 && y < canvas.clientHeight - 2};
    }));
  }).observe(canvas, {attributes: true, attributeFilter: ['data-utime']});
})()`;

async function compareWithTargets(page) {
  await page.value(kWatchMap);
  await page.until('maps with targets', '[...window.maps.values()].filter((rows) => rows.length > 0).length >= 20');
  const maps = await page.value('[...window.maps]');
  const said = await heardAll(targets_file, maps.map(([utime]) => utime));
  let targets_seen = 0;
  for (const [utime, rows] of maps) {
    assert(said.has(utime), `the map shows targets (${utime}) of which TARGETS says nothing`);
    const {targets} = said.get(utime);
    assert(rows.length === targets.length, `${utime}: ${rows.length} targets are listed, ${targets.length} are said`);
    for (const [id, state, east, north] of targets) {
      const row = rows.find((each) => Number(each.id) === id);
      assert(row, `${utime}: target ${id} is not listed`);
      assert(row.state === ['moving', 'stopped', 'coasting'][state], `${utime}: target ${id} is ${row.state}, said is ${state}`);
      const off = Math.hypot(row.east - east, row.north - north);
      assert(off < 0.02, `${utime}: target ${id} is drawn ${off} m from where TARGETS says it`);
      // Footprint and ellipses are translucent, and so is the middle of a ring.
      if (row.is_on && state !== 2) assert(row.alpha === 255, `${utime}: nothing is drawn where target ${id} is`);
      ++targets_seen;
    }
  }
  console.log(`map: ${targets_seen} targets in ${maps.length} maps are those of TARGETS, to 2 cm`);
}

const frames = (page) => page.value('Number(document.getElementById("view").dataset.frames ?? 0)');

async function goesOn(page, what) {
  const before = await frames(page);
  await page.until(`${what}: frames`, `Number(document.getElementById("view").dataset.frames) > ${before + 24}`);
  await page.until(`${what}: objects`, 'document.querySelectorAll("#objects tbody tr").length > 0');
}

async function surviveKills(page) {
  const names = supervisor('status').split('\n').map((line) => line.split(/\s+/)).filter(([, state]) => state === 'RUNNING');
  for (const [name] of names) {
    process.kill(Number(supervisor('pid', name)), 'SIGKILL');
    await goesOn(page, `after ${name} was killed`);
    await page.until('connected', 'document.getElementById("connection").textContent.includes("connected")');
  }
  console.log(`killed, and the page came back: ${names.map(([name]) => name).join(' ')}`);
}

async function replay(page) {
  const choose = `((s) => { s.value = ${JSON.stringify(flight)}; s.dispatchEvent(new Event('change')); })(document.getElementById('source'))`;
  await page.until('the flight is listed', `[...document.querySelectorAll('#source option')].some((o) => o.value === ${JSON.stringify(flight)})`);
  await page.value(choose);
  const position = () => page.value('Number(document.getElementById("position").value)');
  const at = (frame) => page.until(`frame ${frame}`, `document.getElementById("status").textContent.startsWith("frame ${frame} of")`);
  await at(1);
  await page.value('document.activeElement.blur()');
  await page.press('ArrowRight');
  await at(2);
  await page.press('ArrowLeft');
  await at(1);
  await page.press('End');
  await page.until('the end', 'document.getElementById("position").value === document.getElementById("position").max');
  const last = await position();
  await page.press('Home');
  await at(1);
  await page.value('((r) => { r.value = "8"; r.dispatchEvent(new Event("change")); })(document.getElementById("rate"))');
  await page.press(' ');
  await page.until('played to the end', `Number(document.getElementById("position").value) === ${last}`);
  await page.press('4');
  assert(await page.value('getComputedStyle(document.getElementById("boxes")).visibility') === 'hidden', 'the key 4 hides the boxes');
  await page.press('4');
  await page.press('l');
  await goesOn(page, 'live again');
  console.log(`replay: step, seek, play, keys over ${last + 1} frames`);
}

async function record(page) {
  assert(await page.value('document.getElementById("record").hidden') === false, 'there is no button to record');
  await page.value('document.getElementById("record").click()');
  await page.until('recording', 'document.getElementById("record").classList.contains("on")');
  await page.until('the recorder says so', '[...document.querySelectorAll("#processes tbody tr")].some((r) => r.dataset.name === "record" && r.dataset.state === "good")');
  await goesOn(page, 'while it is recorded');
  await page.value('document.getElementById("record").click()');
  await page.until('no longer recording', '!document.getElementById("record").classList.contains("on")');
  console.log('recorded: started and stopped by the button');
}

/** It grows while it is open, is ground nearly everywhere that it is anything, and is asked for only while it is open. */
async function mosaic(page) {
  const asked = () => page.value('performance.getEntriesByType("resource").filter((entry) => entry.name.includes("/api/mosaic")).length');
  assert(await asked() === 0, 'the mosaic is asked for before it is opened');
  await page.press('m');
  const {frames: first, known: little} = await mosaicAfter(page, 0);
  const {frames, known, unit, tracks} = await mosaicAfter(page, first + 8, 'Number(document.getElementById("mosaic").dataset.tracks) > 0');
  assert(unit === 'm', `the mosaic is in ${unit}`);
  assert(known > little, `it shows ${known} pixels, before ${little}`);
  await page.screenshot(path.join(screenshots, 'mosaic.png'), 1400);
  await page.press('m');
  const before = await asked();
  await new Promise((done) => setTimeout(done, 3000));
  assert(await asked() <= before + 1, 'the mosaic is asked for while it is closed');
  console.log(`mosaic: ${frames} frames, ${known} pixels of ground, ${tracks} tracks`);
}

async function mosaicAfter(page, frames, condition = 'true') {
  await page.until('the mosaic grows', `Number(document.getElementById("mosaic").dataset.frames) > ${frames} && ${condition}`);
  return page.value(`(() => {
    const canvas = document.getElementById('mosaic');
    const pixels = new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer);
    const known = pixels.reduce((sum, pixel) => sum + ((pixel & 0xff) > 24), 0);
    return {...canvas.dataset, frames: Number(canvas.dataset.frames), known};
  })()`);
}

async function main() {
  const browser = await Browser.start(chromium);
  try {
    const page = await browser.open(url, 1400, 950);
    await page.until('an object', 'document.querySelectorAll("#objects tbody tr").length > 0', 120);
    await page.until('all processes', 'document.querySelectorAll("#processes tbody tr").length >= 5');
    await page.until('the map', 'document.getElementById("map-note").textContent === ""');
    await compareWithDetections(page);
    await compareWithTargets(page);
    console.log(await tenViewers(url, () => [...heard(detections_file).keys()]));
    await replay(page);
    await record(page);
    console.log(await goesOnWithoutDisk(browser, page));
    await goesOn(page, 'when the disk answers again');
    await mosaic(page);
    await page.screenshot(path.join(screenshots, 'desktop.png'), 1400);
    const phone = await browser.open(url, 390, 844, true);
    await goesOn(phone, 'a phone');
    const width = await phone.value('document.documentElement.scrollWidth');
    assert(width <= 390, `on a phone the page is ${width} px wide`);
    await phone.press('m');
    await mosaicAfter(phone, 0, 'Number(document.getElementById("mosaic-tracks").dataset.labels) > 0');
    const letters = await phone.value('((c) => c.dataset.letters * c.width / c.clientWidth / devicePixelRatio)(document.getElementById("mosaic-tracks"))');
    assert(letters >= 12, `on a phone a track's label is ${letters} px high`);
    await phone.screenshot(path.join(screenshots, 'phone.png'), 390, true);
    await page.send('Page.bringToFront');
    await surviveKills(page);
    assert(browser.errors.length === 0, `faults in the page: ${browser.errors}`);
  } finally {
    await browser.close();
  }
}

main().catch((error) => {
  console.log(`FAILED: ${error.message}`);
  process.exit(1);
});
