// Tracks on the mosaic, on a canvas of the page's own pixels over it: lines and letters are as large on a phone as on a wide
// window. Of labels that would lie over each other the more important is drawn: an end, the newest first, before a time between.
import {colourOf} from './picture.js';

const kLetters_px = 12;
const canvas = document.getElementById('mosaic-tracks');

/** Where the mosaic lies in its canvas's box, which keeps its shape. */
function placing(box, mosaic) {
  const scale = Math.min(box.width / mosaic.width, box.height / mosaic.height);
  const left = (box.width - scale * mosaic.width) / 2;
  const top = (box.height - scale * mosaic.height) / 2;
  return ([x, y]) => [left + scale * (x + 0.5), top + scale * (y + 0.5)];
}

function drawLine(context, points, colour) {
  context.beginPath();
  points.forEach(([x, y], i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
  for (const [style, width] of [['#000', 4], [colour, 2]]) {
    context.strokeStyle = style;
    context.lineWidth = width;
    context.stroke();
  }
}

function drawLabel(context, [x, y], text, colour, taken, size) {
  const width = context.measureText(text).width + 6;
  const height = kLetters_px + 4;
  const left = Math.max(0, Math.min(x + 6, size.width - width));
  const top = Math.max(0, Math.min(y - 6 - height, size.height - height));
  const isOver = (box) => left < box.left + box.width && box.left < left + width && top < box.top + height && box.top < top + height;
  if (taken.some(isOver)) return;
  taken.push({left, top, width});
  context.beginPath();
  context.arc(x, y, 3, 0, 2 * Math.PI);
  context.fillStyle = colour;
  context.fill();
  context.fillStyle = '#000c';
  context.fillRect(left, top, width, height);
  context.fillStyle = colour;
  context.fillText(text, left + 3, top + kLetters_px);
}

/** `mosaic`: width, height and tracks as mosaic_painting.hpp says; over the canvas that shows it. */
export function drawTracks(mosaic, below) {
  const size = {width: below.clientWidth, height: below.clientHeight};
  if (size.width === 0) return;  // closed
  const ratio = window.devicePixelRatio || 1;
  canvas.width = size.width * ratio;
  canvas.height = size.height * ratio;
  const context = canvas.getContext('2d');
  context.scale(ratio, ratio);
  context.lineJoin = 'round';
  context.font = `600 ${kLetters_px}px system-ui, sans-serif`;
  const place = placing(size, mosaic);
  for (const track of mosaic.tracks) drawLine(context, track.points.map(place), colourOf(track.id));
  const labels = mosaic.tracks.flatMap(({id, labels: all}) =>
    all.map(([x, y, text], i) => ({at: place([x, y]), text, rank: Math.min(all.length - i, 3), colour: colourOf(id)})));
  labels.sort((a, b) => a.rank - b.rank);
  const taken = [];
  for (const {at, text, colour} of labels) drawLabel(context, at, text, colour, taken, size);
  // What was drawn, for those who ask.
  Object.assign(canvas.dataset, {labels: taken.length, letters: parseFloat(/([\d.]+)px/.exec(context.font)[1])});
}
