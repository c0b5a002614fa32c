// check_map.js CHROMIUM URL TARGETS SCREENSHOTS GEOLOCATION...: the map in a real browser, without images.
//   TARGETS      what target_trial prints of TARGETS: TARGET,t,status,id,state,latitude,longitude,metres from the truth
//   GEOLOCATION  the command that publishes them
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

async function check(browser) {
  const page = await browser.open(url, 1400, 950);
  await note(page, 'no TARGETS: redbee-geolocation does not answer');
  const program = spawn(geolocation[0], geolocation.slice(1), {stdio: 'ignore'});
  try {
    await page.value(kWatch);
    await inState(page, 'moving');
    await note(page, '');
    await page.until('many places', 'window.rows.size >= 20');
    await page.screenshot(path.join(screenshots, 'map.png'), 1400);
    const phone = await browser.open(url, 390, 844, true);
    await inState(phone, 'moving');
    const width = await phone.value('document.documentElement.scrollWidth');
    assert(width <= 390, `on a phone the page is ${width} px wide`);
    await phone.screenshot(path.join(screenshots, 'map_phone.png'), 390, true);
    await page.send('Page.bringToFront');
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
