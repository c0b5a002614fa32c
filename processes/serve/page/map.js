// The map: a plain metric grid, north up, that follows the drone and its targets.
import {drawTargets, listTargets} from './targets.js';
import {viewControl} from './map_view.js';
import {drawTiles} from './tiles.js';

const canvas = document.getElementById('map');
const note = document.getElementById('map-note');
const kSteps = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];
const kLeast_m = 10;
const kMost_m = 3000;
let last = null;
let view = null;
const control = viewControl(canvas, document.getElementById('map-follow'), () => view, () => last && drawMap(...last));

/** The part of the ground that is shown: {centre, reach}, metres to each side of the canvas's shorter half. With targets it
    is about them and the drone, however far the footprint reaches. It stays while they are in it and it is not far too wide. */
function viewOf(map, before) {
  const anchors = map.own ? [map.own.position, ...(map.own.axis ? [map.own.axis] : [])] : [];
  const points = [...anchors, ...map.targets.map((target) => target.position)];
  if (map.targets.length === 0) points.push(...map.footprint, ...map.path.slice(-200));
  if (points.length === 0) return before ?? {centre: [0, 0], reach: kLeast_m};
  const ends = [0, 1].map((axis) => {
    const values = points.map((point) => point[axis]);
    return [Math.min(...values), Math.max(...values)];
  });
  const half = Math.max(...ends.map(([low, high]) => (high - low) / 2));
  const reach = Math.min(kMost_m, Math.max(kLeast_m, 1.3 * half));
  const is_in = before && ends.every(([low, high], axis) =>
    low > before.centre[axis] - 0.95 * before.reach && high < before.centre[axis] + 0.95 * before.reach);
  if (is_in && before.reach < 1.8 * reach) return before;
  return {centre: ends.map(([low, high]) => (low + high) / 2), reach};
}

/** On a dark edge: tiles may be of any colour. */
function drawWords(context, text, x, y, colour) {
  context.font = '12px system-ui, sans-serif';
  context.lineJoin = 'round';
  context.lineWidth = 3;
  context.strokeStyle = '#000c';
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

function strokeOnEdge(context, colour, width) {
  for (const [style, wide] of [['#000a', width + 2], [colour, width]]) {
    context.strokeStyle = style;
    context.lineWidth = wide;
    context.stroke();
  }
}

function drawGrid(context, size, centre, px_per_m) {
  const step = kSteps.find((s) => s * px_per_m >= 40) ?? kSteps.at(-1);
  context.strokeStyle = '#2b323a';
  context.lineWidth = 1;
  context.beginPath();
  for (const [axis, length, sign] of [[0, size.width, 1], [1, size.height, -1]]) {
    const half = length / 2 / px_per_m;
    for (let m = Math.ceil((centre[axis] - half) / step) * step; m <= centre[axis] + half; m += step) {
      const at = Math.round(length / 2 + sign * (m - centre[axis]) * px_per_m) + 0.5;
      context.moveTo(axis === 0 ? at : 0, axis === 0 ? 0 : at);
      context.lineTo(axis === 0 ? at : size.width, axis === 0 ? size.height : at);
    }
  }
  context.stroke();
  drawWords(context, `grid ${step} m, north up`, 6, size.height - 7, '#eef1f4');
}

function drawOwn(context, [x, y], heading) {
  context.save();
  context.translate(x, y);
  context.rotate(heading);
  context.fillStyle = '#56b4e9';
  context.strokeStyle = '#000';
  context.beginPath();
  context.moveTo(0, -11);
  context.lineTo(7, 8);
  context.lineTo(0, 4);
  context.lineTo(-7, 8);
  context.closePath();
  context.fill();
  context.stroke();
  context.restore();
}

/** From the drone to where the camera looks. */
function drawAxis(context, from, to) {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.setLineDash([5, 4]);
  strokeOnEdge(context, '#e69f00', 1);
  context.setLineDash([]);
}

/** `map`: as map_json.hpp says. */
export function drawMap(map, colourOf = () => '#e69f00') {
  last = [map, colourOf];
  note.textContent = map.note;
  const ratio = window.devicePixelRatio || 1;
  const size = {width: canvas.clientWidth, height: canvas.clientHeight};
  canvas.width = size.width * ratio;
  canvas.height = size.height * ratio;
  const context = canvas.getContext('2d');
  context.scale(ratio, ratio);
  view = control.chosen() ?? viewOf(map, view);
  const {centre} = view;
  const px_per_m = Math.min(size.width, size.height) / 2 / view.reach;
  const place = ([e, n]) => [size.width / 2 + (e - centre[0]) * px_per_m, size.height / 2 - (n - centre[1]) * px_per_m];
  drawTiles(context, size, map.origin, centre, px_per_m, () => last && drawMap(...last));
  drawGrid(context, size, centre, px_per_m);
  const polygon = (points) => {
    context.beginPath();
    points.map(place).forEach(([x, y], i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
  };
  if (map.footprint.length > 0) {
    polygon(map.footprint);
    context.closePath();
    context.fillStyle = '#e69f0026';
    context.fill();
    strokeOnEdge(context, '#e69f00', 1);
  }
  polygon(map.path);
  strokeOnEdge(context, '#eef1f4', 1);
  if (map.own?.axis) drawAxis(context, place(map.own.position), place(map.own.axis));
  drawTargets(context, map.targets, place, px_per_m, colourOf, size.width);
  listTargets(map.targets, colourOf);
  // What was drawn, and where: the centre, its east and north, the scale.
  Object.assign(canvas.dataset, {utime: map.targets_utime ?? '', east: centre[0], north: centre[1], scale: px_per_m});
  if (!map.own) return;
  drawOwn(context, place(map.own.position), map.own.heading);
  if (map.own.height !== undefined) {
    drawWords(context, `${map.own.height.toFixed(1)} m above ground`, 6, 16, '#eef1f4');
  }
}

window.addEventListener('resize', () => last && drawMap(...last));
