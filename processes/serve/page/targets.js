// Targets on the map and in their table. What a colour says of an identity, its number says, too; the state is a shape.

const kShapes = {moving: '\u25b2', stopped: '\u25a0', coasting: '\u25cb'};
const kSigmas = 2;  // of the ellipse, as the legend says
const kAhead_s = 2;  // of the line that shows the velocity

/** A triangle that points where it goes, a square, or a ring. */
function drawShape(context, target, [x, y], colour) {
  context.save();
  context.translate(x, y);
  context.beginPath();
  if (target.state === 'moving') {
    context.rotate(Math.atan2(target.velocity[0], target.velocity[1]));
    context.moveTo(0, -9);
    context.lineTo(6.5, 7);
    context.lineTo(-6.5, 7);
    context.closePath();
  } else if (target.state === 'stopped') {
    context.rect(-6, -6, 12, 12);
  } else {
    context.arc(0, 0, 6.5, 0, 2 * Math.PI);
  }
  context.lineWidth = target.state === 'coasting' ? 5 : 3;
  context.strokeStyle = '#000';
  context.stroke();
  if (target.state === 'coasting') {
    context.lineWidth = 2.5;
    context.strokeStyle = colour;
    context.stroke();
  } else {
    context.fillStyle = colour;
    context.fill();
  }
  context.restore();
}

function drawEllipse(context, {major, minor, angle}, [x, y], px_per_m, colour) {
  context.beginPath();
  // An angle of the map is from north over east, one of the canvas from right over down.
  context.ellipse(x, y, kSigmas * major * px_per_m, kSigmas * minor * px_per_m, angle - Math.PI / 2, 0, 2 * Math.PI);
  context.fillStyle = `${colour}22`;
  context.fill();
  context.lineWidth = 1.5;
  context.strokeStyle = colour;
  context.stroke();
}

function drawName(context, target, [x, y], colour, width) {
  const text = String(target.id);
  context.font = '600 13px system-ui, sans-serif';
  const length = context.measureText(text).width + 6;
  // Not on the line of its velocity, and within the canvas.
  const is_left = (target.state === 'moving' && target.velocity[0] > 0 && x > 11 + length) || x + 11 + length > width;
  const left = is_left ? x - 11 - length : x + 11;
  context.fillStyle = colour;
  context.fillRect(left, y - 9, length, 17);
  context.fillStyle = '#000';
  context.fillText(text, left + 3, y + 4);
}

/** `place` gives the canvas's point of [east, north]. */
export function drawTargets(context, targets, place, px_per_m, colourOf, width) {
  for (const target of targets) drawEllipse(context, target.ellipse, place(target.position), px_per_m, colourOf(target.id));
  for (const target of targets) {
    const at = place(target.position);
    const colour = colourOf(target.id);
    if (target.state === 'moving') {
      context.beginPath();
      context.moveTo(...at);
      context.lineTo(...place(target.position.map((value, axis) => value + kAhead_s * target.velocity[axis])));
      context.lineWidth = 2;
      context.strokeStyle = colour;
      context.stroke();
    }
    drawShape(context, target, at, colour);
    drawName(context, target, at, colour, width);
  }
}

function placeText({position: [east, north], latitude, longitude}) {
  if (latitude !== undefined) return `${latitude.toFixed(6)}\u00b0, ${longitude.toFixed(6)}\u00b0`;
  return `${east.toFixed(1)} m E, ${north.toFixed(1)} m N`;
}

/** A row a target: those that are seen first, then by identity. */
export function listTargets(targets, colourOf) {
  const table = document.getElementById('targets');
  const body = table.tBodies[0];
  table.hidden = document.getElementById('map-legend').hidden = targets.length === 0;
  body.replaceChildren();
  for (const target of [...targets].sort((a, b) => (a.unseen > 0) - (b.unseen > 0) || a.id - b.id)) {
    const row = body.insertRow();
    Object.assign(row.dataset, {id: target.id, state: target.state, east: target.position[0], north: target.position[1]});
    const swatch = document.createElement('span');
    swatch.className = 'swatch';
    swatch.style.background = colourOf(target.id);
    row.insertCell().append(swatch, String(target.id));
    const state = row.insertCell();
    state.textContent = `${kShapes[target.state]} ${target.state}`;
    state.title = target.unseen > 0 ? `not seen for ${target.unseen.toFixed(1)} s` : 'seen in this frame';
    row.insertCell().textContent = target.speed.toFixed(1);
    row.insertCell().textContent = placeText(target);
    row.insertCell().textContent = (kSigmas * target.ellipse.major).toFixed(1);
  }
}
