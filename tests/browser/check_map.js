// check_map.js CHROMIUM URL TARGETS SCREENSHOTS GEOLOCATION...: the map in a real browser, without images.
//   TARGETS      what target_trial prints of TARGETS: TARGET,t,status,id,state,latitude,longitude,metres from the truth
//   GEOLOCATION  the command that publishes them
// REDBEE_FLIGHT: the process of target_trial. REDBEE_OTHER_CAMERA: a vehicle file of another camera.
'use strict';
const {spawn} = require('child_process');
const fs = require('fs');
const path = require('path');
const {Browser} = require('./browser.js');
const [chromium, url, targets_file, screenshots, ...geolocation] = process.argv.slice(2);

const kWalker = 5;  // its identity
const sleep = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
const assert = (is_true, what) => { if (!is_true) throw new Error(what); };
const heard = () => fs.readFileSync(targets_file, 'utf8').split('\n').slice(0, -1).map((line) => line.split(','))
  .filter(([what]) => what === 'TARGET').map(([, , , id, state, latitude, longitude, miss]) => (
    {id: Number(id), state: Number(state), place: [latitude, longitude].map((degrees) => `${Number(degrees).toFixed(6)}\u00b0`).join(', '), miss: Number(miss)}));

/** In the page: every row of the table of targets that was there, as text. */
const kWatch = `(() => {
  window.rows = new Set();
  const table = document.getElementById('targets').tBodies[0];
  new MutationObserver(() => {
    for (const row of table.rows) window.rows.add([row.dataset.id, row.dataset.state, row.cells[3].textContent].join('|'));
  }).observe(table, {childList: true});
})()`;
const note = (page, words) => page.until(`the words "${words}"`, `document.getElementById('map-note').textContent.includes(${JSON.stringify(words)})`);
const inState = (page, state) => page.until(`${state} walker`, `document.querySelector('#targets tr[data-id="${kWalker}"]')?.dataset.state === '${state}'`);

/** Tiles lie under the map; it zooms about the pointer, is dragged, and follows again. What was drawn is in the canvas's data. */
async function checkView(page) {
  await page.until('tiles under the map', 'Number(document.getElementById("map").dataset.tiles) > 0');
  const box = await page.value('(({left, top, width, height}) => ({left, top, width, height}))(document.getElementById("map").getBoundingClientRect())');
  const view = () => page.value('(({east, north, scale}) => ({east: Number(east), north: Number(north), scale: Number(scale)}))(document.getElementById("map").dataset)');
  const at = {x: box.left + box.width / 2 + 60, y: box.top + box.height / 2 - 40};
  const mouse = (type, x, y, more = {}) => page.send('Input.dispatchMouseEvent', {type, x, y, button: 'left', ...more});
  const wheel = (deltaY) => mouse('mouseWheel', at.x, at.y, {button: 'none', deltaX: 0, deltaY});
  const isFollowing = 'document.getElementById("map-follow").hidden';
  await wheel(-100);  // from here on the view stays, whatever moves
  await page.until('the view is chosen', `!${isFollowing}`);
  const before = await view();
  await wheel(-100);
  await page.until('a nearer view', `Number(document.getElementById('map').dataset.scale) > ${before.scale * 1.2}`);
  const near = await view();
  const under = ({east, north, scale}) => [east + 60 / scale, north + 40 / scale];
  const [a, b] = [under(before), under(near)];
  assert(Math.hypot(a[0] - b[0], a[1] - b[1]) < 1.5 / near.scale, `the place under the pointer moved from ${a} to ${b}`);
  await page.screenshot(path.join(screenshots, 'map_near.png'), 1400);
  await mouse('mousePressed', at.x, at.y, {clickCount: 1});
  await mouse('mouseMoved', at.x + 50, at.y + 20, {buttons: 1});
  await mouse('mouseReleased', at.x + 50, at.y + 20, {clickCount: 1});
  const moved = await view();
  assert(Math.abs((near.east - moved.east) * near.scale - 50) < 1.5 && Math.abs((moved.north - near.north) * near.scale - 20) < 1.5,
    `a drag by 50, 20 px moved the map by ${(near.east - moved.east) * near.scale}, ${(moved.north - near.north) * near.scale}`);
  await page.value('document.getElementById("map-follow").click()');
  assert(await page.value(isFollowing), 'the map does not follow again');
  console.log('map: tiles, zoom, drag, follow');
}

/** A tile that the server refuses, as while its disk is busy, is asked for again, until it is there. */
async function checkRefusedTiles(page) {
  const tiles = 'Number(document.getElementById("map").dataset.tiles)';
  const key = async (name) => {
    await page.value('document.getElementById("map").focus()');
    await page.press(name);
  };
  await page.refuse(503, '/api/tile?*');
  const zoom = await page.value('document.getElementById("map").dataset.zoom');
  // To a level of which no tile is there yet: the only ones that are drawn are those that come.
  for (let i = 0; i < 12 && await page.value('document.getElementById("map").dataset.zoom') === zoom; ++i) await key('-');
  await page.until('no tiles where they are refused', `${tiles} === 0`);
  const refused = () => page.browser.held.length;
  for (const end = Date.now() + 60000; refused() < 6;) {
    assert(Date.now() < end, `a refused tile is not asked for again: ${refused()} requests`);
    await sleep(100);
  }
  assert(new Set(page.browser.held).size < refused(), 'no tile was asked for twice');
  await page.release();
  await page.until('the tiles that were refused', `${tiles} > 0`);
  await page.value('document.getElementById("map-follow").click()');
  console.log(`map: ${refused()} refused tiles, and they came when they were given`);
}

/** What makes places wrong is said beside the map: boxes that the configured camera cannot have. */
async function checkOtherCamera(page, [program, option]) {
  await spawnFor([program, option, process.env.REDBEE_OTHER_CAMERA], async () => {
    await note(page, 'DETECTIONS are of another camera than the vehicle file\'s');
    await page.until('its words among the processes', 'document.getElementById("remarks").textContent.includes("DETECTIONS are of another camera: a box ends at")');
    await page.until('no places', 'document.querySelectorAll("#targets tbody tr").length === 0');
    await page.screenshot(path.join(screenshots, 'map_other_camera.png'), 1400);
  });
  console.log('map: another camera is said');
}

async function checkStalePose(page, command) {
  await spawnFor(command, async () => {
    await page.until('no words', 'document.getElementById("map-note").textContent === ""');
    process.kill(Number(process.env.REDBEE_FLIGHT), 'SIGUSR2');
    await note(page, 's old: what is drawn is where the drone was');
    await note(page, 'no POSE near the frame');
    await page.until('its words among the processes', 'document.getElementById("remarks").textContent.includes("from the frame, allowed are")');
    await page.screenshot(path.join(screenshots, 'map_stale_pose.png'), 1400);
  });
  console.log('map: a stale pose is said');
}

async function spawnFor(command, work) {
  const program = spawn(command[0], command.slice(1), {stdio: 'ignore'});
  try {
    await work();
  } finally {
    program.kill('SIGKILL');
  }
}

/** Two fingers that part to twice their distance: the map is twice as large, and each stays where it was on the ground. */
async function checkPinch(phone) {
  await phone.send('Page.bringToFront');
  await phone.send('Emulation.setTouchEmulationEnabled', {enabled: true, maxTouchPoints: 2});
  const box = await phone.value(`(() => {
    document.getElementById('map').scrollIntoView({block: 'center'});
    const {left, top, width, height} = document.getElementById('map').getBoundingClientRect();
    return {x: left + width / 2, y: top + height / 2, scrolled: scrollY};
  })()`);
  const touch = (type, ...apart) => phone.send('Input.dispatchTouchEvent', {type, touchPoints: apart.map((dx, id) => ({x: box.x + dx, y: box.y, id}))});
  const view = () => phone.value('(({east, north, scale}) => ({east: Number(east), north: Number(north), scale: Number(scale)}))(document.getElementById("map").dataset)');
  await touch('touchStart', -40, 40);
  await touch('touchMove', -41, 40);  // from here on the view stays, whatever moves
  await phone.until('the view is chosen', '!document.getElementById("map-follow").hidden');
  const before = await view();
  for (const dx of [50, 60, 70, 80]) await touch('touchMove', -dx - 1, dx);
  await touch('touchEnd');
  const after = await view();
  const ratio = after.scale / before.scale;
  assert(Math.abs(ratio - 161 / 81) < 0.02, `two fingers from 81 to 161 px enlarge the map by ${ratio}`);
  // The place in the middle between the fingers, half a pixel to the left of the canvas's middle.
  const off = [(after.east - before.east - 0.5 / after.scale + 0.5 / before.scale) * after.scale, (after.north - before.north) * after.scale];
  assert(Math.hypot(...off) < 1, `the place between the fingers moved by ${off} px`);
  assert(await phone.value('scrollY') === box.scrolled, 'the page scrolls under the fingers');
  await touch('touchStart', 0);
  await touch('touchMove', 30);
  await touch('touchEnd');
  const moved = await view();
  assert(Math.abs((after.east - moved.east) * after.scale - 30) < 1.5, `a finger by 30 px moved the map by ${(after.east - moved.east) * after.scale}`);
  await phone.value('document.getElementById("map-follow").click()');
  console.log('map: two fingers, one finger');
}

async function check(browser) {
  const page = await browser.open(url, 1400, 950);
  await note(page, 'no TARGETS: redbee-geolocation does not answer');
  // Most processes are silent here, in the longest word for a state, and their table stays within its panel.
  await page.until('the processes', 'document.querySelectorAll("#processes td.bad").length >= 4');
  await page.until('the words for it', 'document.getElementById("processes").hidden && /no process of a stack reports/.test(document.getElementById("remarks").textContent)');
  const [wide, room] = await page.value(`(() => {
    document.getElementById("processes").hidden = false;
    return ((s) => [s.scrollWidth, s.clientWidth])(document.querySelector("section[aria-label=processes]"));
  })()`);
  assert(wide <= room, `the table of the processes is ${wide} px wide in ${room} px`);
  await checkOtherCamera(page, geolocation);
  const program = spawn(geolocation[0], geolocation.slice(1), {stdio: 'ignore'});
  try {
    await page.value(kWatch);
    await inState(page, 'moving');
    await note(page, '');
    await page.until('many places', 'window.rows.size >= 20');
    await page.screenshot(path.join(screenshots, 'map.png'), 1400);
    await checkView(page);
    await checkRefusedTiles(page);
    const phone = await browser.open(url, 390, 844, true);
    await inState(phone, 'moving');
    const width = await phone.value('document.documentElement.scrollWidth');
    assert(width <= 390, `on a phone the page is ${width} px wide`);
    await phone.screenshot(path.join(screenshots, 'map_phone.png'), 390, true);
    await checkPinch(phone);
    await page.send('Page.bringToFront');
    process.kill(Number(process.env.REDBEE_FLIGHT), 'SIGUSR1');  // the walker stands from now on, however long all this took
    await inState(page, 'stopped');
    const rows = await page.value('[...window.rows]');
    // The listener may be behind the page.
    for (let i = 0; i < 200 && !rows.every((row) => heard().some(({place}) => place === row.split('|')[2])); ++i) await sleep(50);
    const said = heard();
    for (const row of rows) {
      const [id, , place] = row.split('|');
      assert(Number(id) === kWalker, `there is a target ${id}`);
      const message = said.find((each) => each.place === place);
      assert(message, `the page says ${place}, TARGETS never did`);
      assert(message.miss < 3, `the page says ${place}, ${message.miss} m from the walker`);
    }
    console.log(`map: ${rows.length} places of the walker are those of TARGETS`);
  } finally {
    program.kill('SIGKILL');
  }
  await note(page, 'no TARGETS for');
  assert(await page.value('document.querySelectorAll("#targets tbody tr").length') === 0, 'targets stay on a map that has none');
  await checkStalePose(page, geolocation);
  assert(browser.errors.length === 0, `faults in the page: ${browser.errors}`);
}

async function main() {
  const browser = await Browser.start(chromium);
  try {
    await check(browser);
  } finally {
    await browser.close();
  }
}

main().catch((error) => {
  console.log(`FAILED: ${error.message}`);
  process.exit(1);
});
