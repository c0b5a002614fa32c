// Tiles of a local folder under the map: WebMercator, z/x/y.
const kEquator_m = 6378137;  // WGS-84
const kFlattening = 1 / 298.257223563;
const kMostKept = 300;
const kMostDrawn = 64;
const kMostAsked = 2;  // at a time: the live image needs connections too, also where the disk is slow
const kRetry_ms = 3000;  // where the server refuses, as when its disk is busy, or cannot be reached
const kept = new Map();  // images by z/x/y; null: it has not come yet, or there is none
let waiting = 0;
let levels = [];
let redrawWithTiles = () => {};

async function fetchLevels() {
  try {
    const answer = await fetch('/api/tiles');
    if (!answer.ok) throw new Error(`status ${answer.status}`);
    levels = await answer.json();
  } catch (error) {
    setTimeout(fetchLevels, kRetry_ms);
    return;
  }
  if (levels.length > 0) redrawWithTiles();
}
fetchLevels();

/** Metres a radian of latitude and of longitude at the origin. */
function radiiAt(latitude) {
  const e2 = kFlattening * (2 - kFlattening);
  const w = 1 - e2 * Math.sin(latitude) ** 2;
  return {north: kEquator_m * (1 - e2) / w ** 1.5, east: kEquator_m / Math.sqrt(w) * Math.cos(latitude)};
}

const rowOf = (latitude, count) => (1 - Math.asinh(Math.tan(latitude)) / Math.PI) / 2 * count;
const latitudeOf = (row, count) => Math.atan(Math.sinh(Math.PI * (1 - 2 * row / count)));

/** null: there is none, and asking again would not help. Throws where it would. */
async function fetchTile(z, x, y) {
  const answer = await fetch(`/api/tile?z=${z}&x=${x}&y=${y}`);
  if (answer.status >= 500) throw new Error(`status ${answer.status}`);
  if (!answer.ok) return null;
  const content = await answer.blob();
  return createImageBitmap(content).catch(() => null);
}

function tile(z, x, y, arrived) {
  const key = `${z}/${x}/${y}`;
  if (!kept.has(key)) {
    if (waiting >= kMostAsked) return null;
    if (kept.size >= kMostKept) kept.delete(kept.keys().next().value);
    ++waiting;
    kept.set(key, null);
    const retry = () => {
      kept.delete(key);
      arrived();
    };
    // The next is asked for when it is drawn again.
    fetchTile(z, x, y).then((image) => kept.set(key, image)).catch(() => setTimeout(retry, kRetry_ms)).finally(() => {
      --waiting;
      arrived();
    });
  }
  return kept.get(key);
}

/** `origin`: {latitude, longitude} of the map's [0, 0] in degrees; without it, and without tiles, nothing is drawn.
    Flat about the origin, as the map is: a kilometre away a tile is off by some centimetres. */
export function drawTiles(context, size, origin, centre, px_per_m, redraw) {
  if (!origin) return;
  if (levels.length === 0) {
    redrawWithTiles = redraw;
    return;
  }
  const [latitude, longitude] = [origin.latitude, origin.longitude].map((degrees) => degrees * Math.PI / 180);
  const radii = radiiAt(latitude);
  const wanted = Math.log2(2 * Math.PI * radii.east * px_per_m / 256);
  const z = levels.reduce((best, level) => (Math.abs(level - wanted) < Math.abs(best - wanted) ? level : best));
  const count = 2 ** z;
  const east = (column) => ((column / count * 2 - 1) * Math.PI - longitude) * radii.east;
  const north = (row) => (latitudeOf(row, count) - latitude) * radii.north;
  const half = [size.width, size.height].map((length) => length / 2 / px_per_m);
  const column = (m) => ((m / radii.east + longitude) / Math.PI + 1) / 2 * count;
  const row = (m) => rowOf(m / radii.north + latitude, count);
  const [left, right] = [column(centre[0] - half[0]), column(centre[0] + half[0])].map(Math.floor);
  const [top, bottom] = [row(centre[1] + half[1]), row(centre[1] - half[1])].map(Math.floor);
  if ((right - left + 1) * (bottom - top + 1) > kMostDrawn) return;  // far below the smallest level
  const across = (m) => size.width / 2 + (m - centre[0]) * px_per_m;
  const down = (m) => size.height / 2 - (m - centre[1]) * px_per_m;
  let drawn = 0;
  for (let y = Math.max(0, top); y <= Math.min(count - 1, bottom); ++y) {
    for (let x = left; x <= right; ++x) {
      const image = tile(z, (x + count) % count, y, redraw);
      if (!image) continue;
      ++drawn;
      const [x0, y0] = [across(east(x)), down(north(y))];
      context.drawImage(image, x0, y0, across(east(x + 1)) - x0 + 0.5, down(north(y + 1)) - y0 + 0.5);
    }
  }
  Object.assign(context.canvas.dataset, {tiles: drawn, zoom: z});
}
