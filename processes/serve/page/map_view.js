// What part of the ground the map shows, where a person has chosen it: wheel, drag, two fingers, keys.
const kNearest_m = 1;
const kFarthest_m = 50000;
const kStep = 1.25;

/** `current`: the view that is drawn, {centre, reach}: metres to each side of the canvas's shorter half. `changed` draws anew.
    chosen() is null while the map follows the drone; `follow` is the button that leads back to that. */
export function viewControl(canvas, follow, current, changed) {
  let chosen = null;
  const fingers = new Map();
  const scale = () => Math.min(canvas.clientWidth, canvas.clientHeight) / 2 / current().reach;
  const choose = (view) => {
    chosen = view;
    follow.hidden = view === null;
    changed();
  };
  const pan = (right_px, down_px) => {
    if (!current()) return;
    const {centre: [e, n], reach} = current();
    choose({centre: [e - right_px / scale(), n + down_px / scale()], reach});
  };
  /** The place under (x, y), from the canvas's upper left, stays where it is. */
  const zoom = (factor, x = canvas.clientWidth / 2, y = canvas.clientHeight / 2) => {
    if (!current()) return;
    const {centre: [e, n], reach: before} = current();
    const reach = Math.min(kFarthest_m, Math.max(kNearest_m, before / factor));
    const moved = (1 - reach / before) / scale();
    choose({centre: [e + (x - canvas.clientWidth / 2) * moved, n - (y - canvas.clientHeight / 2) * moved], reach});
  };
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    zoom(event.deltaY < 0 ? kStep : 1 / kStep, event.offsetX, event.offsetY);
  }, {passive: false});
  canvas.addEventListener('pointerdown', (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, [event.offsetX, event.offsetY]);
  });
  canvas.addEventListener('pointermove', (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const now = [event.offsetX, event.offsetY];
    fingers.set(event.pointerId, now);
    if (fingers.size === 1) return pan(now[0] - before[0], now[1] - before[1]);
    const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
    const apart = (point) => Math.hypot(point[0] - other[0], point[1] - other[1]);
    if (apart(before) > 0) zoom(apart(now) / apart(before), ...other);
  });
  for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (event) => fingers.delete(event.pointerId));
  const keys = {
    '+': () => zoom(kStep), '=': () => zoom(kStep), '-': () => zoom(1 / kStep), f: () => choose(null),
    ArrowLeft: () => pan(40, 0), ArrowRight: () => pan(-40, 0), ArrowUp: () => pan(0, 40), ArrowDown: () => pan(0, -40),
  };
  canvas.addEventListener('keydown', (event) => {
    if (!(event.key in keys)) return;
    event.preventDefault();
    event.stopPropagation();  // the same keys step and change the rate of a replay
    keys[event.key]();
  });
  follow.onclick = () => choose(null);
  return {chosen: () => chosen};
}
