// A disk, or a supervisor, that does not answer: what waits for it must not take the few connections that a browser has for a server,
// which the live image needs.
'use strict';

const kFrames = 24;
const kWatched_ms = 7000;  // the page asks for its state every 2 s

/** Throws where the page asks again for what it has not been told yet, or shows no new frames. Returns words about it. */
async function goesOnWithoutDisk(browser, page) {
  await page.hold('/api/state', '/api/flights');
  const shown = await page.value('Number(document.getElementById("view").dataset.frames)');
  await page.until('frames, while nothing answers of the disk', `Number(document.getElementById("view").dataset.frames) > ${shown + kFrames}`);
  await new Promise((done) => setTimeout(done, kWatched_ms));
  const asked = browser.held.filter((address) => address.endsWith('/api/state')).length;
  if (asked !== 1) throw new Error(`${asked} requests wait for an answer to the same question`);
  await page.release();
  return 'the image goes on while the disk does not answer';
}

module.exports = {goesOnWithoutDisk};
