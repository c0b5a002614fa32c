// The image and its layers. All are canvases of the raw image's size, one over the other: what is drawn at a pixel is
// what DETECTIONS says of it, however large the page shows it.

// Found by search: with any of the three kinds of colour-blindness they differ (tests/browser/check_colours.js), and carry black letters.
const kColours = ['#ffd500', '#a466eb', '#2d9e61', '#f66f0e', '#b9ff7d', '#cb6aaf', '#50ed97'];
const kUnseen = '#c8c8c8';
const kMask = [86, 180, 233, 110];
const layers = {};
for (const name of ['image', 'mask', 'trails', 'boxes', 'names']) {
  const canvas = document.getElementById(name);
  layers[name] = {canvas, context: canvas.getContext('2d', {willReadFrequently: name === 'mask' || name === 'boxes'})};
}

export function colourOf(id) { return kColours[Math.abs(id) % kColours.length]; }

export function showLayer(name, is_shown) { layers[name].canvas.style.visibility = is_shown ? 'visible' : 'hidden'; }

function resize(width, height) {
  for (const {canvas} of Object.values(layers)) {
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
  }
}

function clear(name) {
  const {canvas, context} = layers[name];
  context.clearRect(0, 0, canvas.width, canvas.height);
  return context;
}

/** Image pixels of a pixel of the page. */
function scale() {
  const {canvas} = layers.image;
  return canvas.clientWidth > 0 ? canvas.width / canvas.clientWidth : 1;
}

function drawMask(mask) {
  const context = clear('mask');
  if (!mask) return;
  context.drawImage(mask, 0, 0);
  const pixels = context.getImageData(0, 0, mask.width, mask.height);
  const data = new Uint32Array(pixels.data.buffer);
  const tint = new Uint32Array(new Uint8ClampedArray(kMask).buffer)[0];
  for (let i = 0; i < data.length; ++i) data[i] = data[i] & 0x80 ? tint : 0;
  context.putImageData(pixels, 0, 0);
}

/** The outline's outer edge is the box: of its pixels the outermost are drawn, and further ones inwards. One that is
    not seen is dashed. */
function drawBox(context, box, line) {
  const {x, y, width, height} = box;
  context.fillStyle = box.seen ? colourOf(box.id) : kUnseen;
  const thick = Math.max(1, Math.min(line, Math.floor(width / 2), Math.floor(height / 2)));
  const dash = box.seen ? Infinity : 4 * line;
  const strip = (from, to, draw) => {
    for (let at = from; at < to; at += 2 * dash) draw(at, Math.min(dash, to - at));
  };
  strip(x, x + width, (at, n) => context.fillRect(at, y, n, thick));
  strip(x, x + width, (at, n) => context.fillRect(at, y + height - thick, n, thick));
  strip(y, y + height, (at, n) => context.fillRect(x, at, thick, n));
  strip(y, y + height, (at, n) => context.fillRect(x + width - thick, at, thick, n));
}

function drawName(context, box, size, edge) {
  const text = String(box.id);
  context.font = `600 ${size}px system-ui, sans-serif`;
  const width = context.measureText(text).width + size * 0.6;
  const x = Math.max(0, Math.min(box.x, edge.width - width));
  const y = box.y >= size * 1.3 ? box.y - size * 1.3 : Math.min(box.y + box.height, edge.height - size * 1.3);
  context.fillStyle = box.seen ? colourOf(box.id) : kUnseen;
  context.fillRect(x, y, width, size * 1.25);
  context.fillStyle = '#000';
  context.fillText(text, x + size * 0.3, y + size);
}

function drawTrail(context, trail, line) {
  const draw = (colour, width) => {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    trail.points.forEach(([x, y], i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
    context.stroke();
  };
  draw('#000a', 2.5 * line);
  draw(colourOf(trail.id), line);
}

/** `frame`: as wire.js gives it. */
export function drawFrame(frame) {
  if (frame.width > 0) resize(frame.width, frame.height);
  if (frame.image) layers.image.context.drawImage(frame.image, 0, 0);
  drawMask(frame.mask);
  const line = Math.max(1, Math.round(2 * scale()));
  const trails = clear('trails');
  trails.lineJoin = 'round';
  for (const trail of frame.trails ?? []) drawTrail(trails, trail, line);
  const boxes = clear('boxes');
  const names = clear('names');
  for (const box of frame.detections ?? []) {
    drawBox(boxes, box, line);
    drawName(names, box, Math.round(13 * scale()), layers.names.canvas);
  }
  frame.image?.close();
  frame.mask?.close();
}

export function clearFrame() { for (const name of Object.keys(layers)) clear(name); }
