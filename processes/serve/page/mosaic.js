// The ground as one image, which grows while somebody looks: asked for only while its view is open.
import {drawTracks} from './tracks.js';
import {fetchFrame} from './wire.js';

const kPeriod_ms = 1000;
const kOld_s = 5;
const box = document.getElementById('mosaic-view');
const canvas = document.getElementById('mosaic');
const note = document.getElementById('mosaic-note');
let shown = 0;
let last_time = 0;
let is_busy = false;
let newest = null;

function draw(mosaic) {
  canvas.width = mosaic.width;
  canvas.height = mosaic.height;
  canvas.getContext('2d').drawImage(mosaic.image, 0, 0);
  mosaic.image.close();
  document.getElementById('mosaic-stage').hidden = false;
  newest = mosaic;
  drawTracks(mosaic, canvas);
  document.getElementById('mosaic-notes').textContent = mosaic.notes.join('; ');
  const seconds = (mosaic.utime - mosaic.start) / 1e6;
  const scale = mosaic.unit === 'm' ? `${(100 * mosaic.units_per_px).toFixed(1)} cm` : `${mosaic.units_per_px.toFixed(1)} px of its first frame`;
  document.getElementById('mosaic-status').textContent = [`${mosaic.width}x${mosaic.height} px of ${scale}`,
    `${mosaic.frames} frames in ${seconds.toFixed(0)} s`, `${mosaic.tracks.length} track${mosaic.tracks.length === 1 ? '' : 's'}`].join('  \u00b7  ');
  Object.assign(canvas.dataset, {utime: mosaic.utime, sequence: mosaic.sequence, frames: mosaic.frames, tracks: mosaic.tracks.length,
    unit: mosaic.unit, scale: mosaic.units_per_px});
}

/** Empty: nothing is missing. */
function wordsFor(silence_s) {
  if (shown === 0) return 'no mosaic yet: it needs images with a valid mask, and the ground\u2019s homography (FUSED_HOMOGRAPHY)';
  return silence_s > kOld_s ? `nothing new for ${silence_s.toFixed(0)} s: no image, no valid mask or no homography of the ground` : '';
}

async function refresh(isLive) {
  if (is_busy || !box.open || document.hidden) return;
  if (!isLive()) {
    note.textContent = 'it grows live only; of a flight on disk redbee mosaic makes one';
    return;
  }
  is_busy = true;
  try {
    const mosaic = await fetchFrame(`/api/mosaic?after=${shown}`);
    if (mosaic) {
      shown = mosaic.sequence;
      last_time = performance.now();
      draw(mosaic);
    }
    note.textContent = wordsFor((performance.now() - last_time) / 1000);
  } catch (error) {
    note.textContent = error.message;
  }
  is_busy = false;
}

/** `isLive`: false while a flight on disk is shown. */
export function watchMosaic(isLive) {
  box.addEventListener('toggle', () => refresh(isLive));
  setInterval(() => refresh(isLive), kPeriod_ms);
  new ResizeObserver(() => newest && drawTracks(newest, canvas)).observe(canvas);
}

/** The server may be another, which counts anew. */
export function restartMosaic() { shown = 0; }

export function toggleMosaic() { box.open = !box.open; }
