// The page: what is shown where, buttons and keys.
import {drawHealth} from './health.js';
import {Live} from './live.js';
import {drawMap} from './map.js';
import {restartMosaic, toggleMosaic, watchMosaic} from './mosaic.js';
import {clearFrame, colourOf, drawFrame, showLayer} from './picture.js';
import {Replay} from './replay.js';
import {fetchJson, listen, unlessBusy, write} from './wire.js';

const element = (id) => document.getElementById(id);
const kSilence_s = 2;
let replay = null;
let opening = new AbortController();
let state = {writes: false, supervised: false, recording: false};
let drawn = [];
let live_map = {note: 'no POSE and no TARGETS have come', path: [], footprint: [], targets: []};

function drawObjects(detections) {
  const body = document.querySelector('#objects tbody');
  body.replaceChildren();
  for (const box of detections) {
    const row = body.insertRow();
    const name = row.insertCell();
    const swatch = document.createElement('span');
    swatch.className = 'swatch';
    swatch.style.background = box.seen ? colourOf(box.id) : '#c8c8c8';
    name.append(swatch, String(box.id));
    for (const value of [box.x, box.y, box.width, box.height, box.score.toFixed(2), box.seen ? 'seen' : 'predicted'])
      row.insertCell().textContent = String(value);
  }
}

function frameRate() {
  const now = performance.now();
  drawn = [...drawn.filter((time) => now - time < 2000), now];
  return drawn.length > 1 ? (1000 * (drawn.length - 1)) / (now - drawn[0]) : 0;
}

function show(frame) {
  drawFrame(frame);
  if (frame.map) drawMap(frame.map, colourOf);
  drawObjects(frame.detections ?? []);
  element('note').textContent = frame.note;
  const fps = frameRate();
  const words = [replay ? `frame ${replay.wanted + 1} of ${replay.times.length}` : 'live', fps > 0 && `${fps.toFixed(1)} fps`,
                 `${(frame.utime / 1e6).toFixed(3)} s`, frame.status, frame.source && `ground: ${frame.source}`];
  element('status').textContent = words.filter((word) => word).join('  \u00b7  ');
  const view = element('view');
  view.dataset.utime = frame.utime;
  view.dataset.frames = Number(view.dataset.frames ?? 0) + 1;
}

/** Live, it comes by itself: POSE and TARGETS are later than the frame, or there are no frames. */
function showLiveMap() {
  if (!replay && live.is_on) drawMap(live_map, colourOf);
}

const fail = (words) => { element('note').textContent = words; };
const live = new Live(show, fail);

function showReplay(frame, k) {
  show(frame);
  element('position').value = k;
  element('time').textContent = `${replay.timeOf(k).toFixed(2)} s`;
  element('play').textContent = replay.is_playing ? 'Pause' : 'Play';
}

async function choose(name) {
  opening.abort();  // a flight that is still being read
  opening = new AbortController();
  const {signal} = opening;
  replay?.close();
  replay = null;
  clearFrame();
  drawObjects([]);
  element('note').textContent = '';
  live.is_on = name === '';
  live.shown = 0;
  element('source').value = name;
  if (name !== '') {
    element('note').textContent = `reading ${name}`;
    try {
      replay = await Replay.open(name, showReplay, fail, signal);
      element('position').max = replay.last;
      replay.setRate(Number(element('rate').value));
      replay.seek(0);
    } catch (error) {
      if (signal.aborted) return;
      fail(error.message);
    }
  }
  element('replay').hidden = element('seek').hidden = !replay;
  element('play').textContent = replay ? 'Play' : 'Pause';
  showLiveMap();
  live.pump();
}

function togglePlay() {
  if (replay) {
    if (replay.is_playing) replay.pause();
    else replay.play();
    element('play').textContent = replay.is_playing ? 'Pause' : 'Play';
  } else {
    live.is_on = !live.is_on;
    element('play').textContent = live.is_on ? 'Pause' : 'Go on';
    live.pump();
  }
}

function changeRate(by) {
  const rates = element('rate');
  rates.selectedIndex = Math.max(0, Math.min(rates.options.length - 1, rates.selectedIndex + by));
  replay?.setRate(Number(rates.value));
}

function toggleLayer(number) {
  const box = document.querySelectorAll('#layers input')[number];
  box.checked = !box.checked;
  showLayer(box.dataset.layer, box.checked);
}

const keys = {
  ' ': togglePlay,
  ArrowLeft: (event) => (event.shiftKey ? replay?.stepSeconds(-1) : replay?.step(-1)),
  ArrowRight: (event) => (event.shiftKey ? replay?.stepSeconds(1) : replay?.step(1)),
  Home: () => replay?.seek(0),
  End: () => replay?.seek(replay.last),
  '-': () => changeRate(-1),
  '+': () => changeRate(1),
  l: () => choose(''),
  m: toggleMosaic,
};

document.addEventListener('keydown', (event) => {
  const is_of_control = ['SELECT', 'BUTTON', 'SUMMARY'].includes(event.target.tagName) && !['l', 'm'].includes(event.key);
  if (event.ctrlKey || event.altKey || event.metaKey || is_of_control) return;
  if (/^[1-5]$/.test(event.key)) return toggleLayer(Number(event.key) - 1);
  if (!(event.key in keys)) return;
  event.preventDefault();
  keys[event.key](event);
});

element('play').onclick = togglePlay;
element('back').onclick = () => replay?.step(-1);
element('forward').onclick = () => replay?.step(1);
element('position').oninput = (event) => replay?.seek(Number(event.target.value));
element('rate').onchange = () => changeRate(0);
element('source').onchange = (event) => choose(event.target.value);
for (const box of document.querySelectorAll('#layers input')) {
  box.onchange = () => showLayer(box.dataset.layer, box.checked);
}
element('record').onclick = async () => {
  const fault = await write(`/api/record?on=${state.recording ? 0 : 1}`);
  if (fault !== '') fail(fault);
  refreshState();
};

const refreshState = unlessBusy(async () => {
  try {
    state = await fetchJson('/api/state');
  } catch (error) {
    return;
  }
  const button = element('record');
  button.hidden = !state.supervised;
  button.disabled = !state.writes;
  button.title = state.writes ? '' : 'the page may only look: serve.allow_writes is false';
  button.textContent = state.recording ? '\u25cf Recording: stop' : 'Record';
  button.classList.toggle('on', state.recording);
});

const megabytes = (bytes) => `${(bytes / 1e6).toFixed(1)} MB`;

const setReportsNote = (words) => { element('reports').textContent = words; };
const refreshFlights = unlessBusy(async () => {
  const {flights, reports} = await fetchJson('/api/flights');
  const source = element('source');
  const chosen = source.value;
  source.replaceChildren(new Option('live', ''), ...flights.map(({name, bytes}) => new Option(`${name} (${megabytes(bytes)})`, name)));
  source.value = chosen;
  element('reports').replaceChildren(...reports.map(({name}) => {
    const link = document.createElement('a');
    link.href = `/report?name=${encodeURIComponent(name)}`;
    link.textContent = name;
    link.target = '_blank';
    const item = document.createElement('li');
    item.append(link);
    return item;
  }));
  if (reports.length === 0) setReportsNote('none in the folders of --flights');
}, () => setReportsNote('the disk of the flights has not answered yet'));

listen({
  frame: (sequence) => live.onFrame(sequence),
  map: (map) => {
    live_map = map;
    showLiveMap();
  },
  health: (health) => drawHealth(health, state.writes && state.supervised),
  connected: (is_connected) => {
    const words = element('connection');
    words.textContent = is_connected ? '\u25cf connected' : '\u25a0 connection lost, trying again';
    words.className = is_connected ? 'good' : 'bad';
    if (is_connected) {
      live.shown = 0;
      restartMosaic();
      refreshState();
      refreshFlights().catch((error) => setReportsNote(error.message));
    }
  },
});
setInterval(() => {
  if (!replay && live.is_on && live.silence() > kSilence_s)
    element('note').textContent = `no image for ${live.silence().toFixed(0)} s: is the camera running? A flight on disk: choose it above`;
}, 500);
setInterval(refreshState, 2000);
setInterval(() => refreshFlights().catch((error) => setReportsNote(error.message)), 10000);
watchMosaic(() => !replay);
showLiveMap();
