// Ten viewers that fetch as the page does: each gets the newest frame whenever it asks, and nothing is kept for who is slow.
'use strict';
const http = require('http');

const kViewers = 10;
const kSlow = 2;       // of them, which think a while about each frame
const kThink_ms = 700;
const kRate_hz = 24;    // of the flight
const kFrames = 60;    // of a quick one
const kLongest_s = 120; // for all of it
const kAhead = 2;      // a frame may come between the answer to one viewer and to another

const get = (url) => new Promise((resolve, reject) => {
  http.get(url, (response) => {
    const parts = [];
    response.on('data', (part) => parts.push(part));
    response.on('end', () => resolve({status: response.statusCode, body: Buffer.concat(parts)}));
  }).on('error', reject);
});

/** The events' newest frame in `viewer.newest`, until `viewer.request` is destroyed. */
function listen(url, viewer) {
  viewer.request = http.get(new URL('/api/events', url), (response) => {
    let rest = '';
    response.on('data', (data) => {
      rest += data;
      for (let end; (end = rest.indexOf('\n\n')) >= 0; rest = rest.slice(end + 2)) {
        const found = /^event: frame\ndata: (\d+)/m.exec(rest.slice(0, end));
        if (found) viewer.newest = Number(found[1]);
      }
    });
  });
  viewer.request.on('error', () => {});
}

const sleep = (ms) => new Promise((done) => setTimeout(done, ms));

/** Fetches whenever there is a newer one, until isOver(). */
async function view(url, viewer, think_ms, isOver, seen) {
  listen(url, viewer);
  for (let shown = 0; !isOver();) {
    if (viewer.newest <= shown) {
      await sleep(2);
      continue;
    }
    const before = seen.newest;  // what somebody had been given when this one asked
    const {status, body} = await get(new URL(`/api/frame?after=${shown}`, url));
    if (status !== 200) {
      await sleep(2);
      continue;
    }
    const {sequence} = JSON.parse(body.subarray(4, 4 + body.readUInt32BE(0)));
    if (sequence <= shown) throw new Error(`a viewer is given frame ${sequence} after ${shown}`);
    if (sequence < before - kAhead) throw new Error(`a viewer is given frame ${sequence} where another had ${before} before it asked`);
    shown = sequence;
    seen.newest = Math.max(seen.newest, sequence);
    viewer.frames.push(sequence);
    if (think_ms > 0) await sleep(think_ms);
  }
  viewer.request.destroy();
}

async function watchAll(url) {
  const viewers = [...Array(kViewers)].map(() => ({newest: 0, frames: []}));
  const seen = {newest: 0};
  const quick = viewers.slice(kSlow);
  const end = Date.now() + 1000 * kLongest_s;
  const isOver = () => {
    if (Date.now() > end) throw new Error(`after ${kLongest_s} s the viewers have been given ${quick.map(({frames}) => frames.length)} frames`);
    return quick.every(({frames}) => frames.length >= kFrames);
  };
  await Promise.all(viewers.map((viewer, i) => view(url, viewer, i < kSlow ? kThink_ms : 0, isOver, seen)));
  const {frames} = viewers[0];
  const leap = Math.max(...frames.slice(1).map((sequence, i) => sequence - frames[i]));
  if (frames.length > 1 && leap < 2) throw new Error('who is slow is given every frame: they wait for it somewhere');
  const counts = viewers.map((viewer) => viewer.frames.length);
  return `${kViewers} viewers: ${Math.min(...counts.slice(kSlow))} to ${Math.max(...counts.slice(kSlow))} frames each, the slow ones ` +
    `${counts.slice(0, kSlow).join(' and ')}; each the newest`;
}

/** Throws where one is given an old frame. Returns words about it, and of which part of its frames the flight had DETECTIONS
    before and meanwhile. `times`: gives the times of all DETECTIONS, us. */
async function tenViewers(url, times) {
  const answeredWhile = async (work) => {
    const from = times().length;
    const words = await work();
    const meanwhile = times().slice(from);
    const part = 100 * (meanwhile.length - 1) / (kRate_hz * (meanwhile.at(-1) - meanwhile[0]) / 1e6);
    return {words, part: `${part.toFixed(0)} %`};
  };
  const alone = await answeredWhile(() => sleep(5000));
  const together = await answeredWhile(() => watchAll(url));
  return `${together.words}; DETECTIONS of ${together.part} of the frames, before of ${alone.part}`;
}

module.exports = {tenViewers};
