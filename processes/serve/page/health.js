// The table of the processes, as `redbee top` has it.
import {write} from './wire.js';

const kShapes = {good: '\u25cf', warning: '\u25b2', bad: '\u25a0', plain: ''};
const body = document.querySelector('#processes tbody');
const remarks = document.getElementById('remarks');

function cell(row, text, tone = '') {
  const td = row.insertCell();
  td.textContent = text;
  td.className = tone;
  return td;
}

function restartButton(name) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = 'restart';
  button.title = `restart ${name}`;
  button.onclick = async () => {
    button.disabled = true;
    const fault = await write(`/api/restart?process=${encodeURIComponent(name)}`);
    if (fault !== '') alert(fault);
  };
  return button;
}

const figure = (value, digits) => (value === undefined ? '' : value.toFixed(digits));

/** Nobody but this page's own process: a flight on disk is looked at, and nothing is missing. */
function sayThatNothingFlies() {
  const item = document.createElement('li');
  item.textContent = 'no process of a stack reports here: none flies, or in another network. Flights on disk: choose one above';
  remarks.prepend(item);
}

/** `health`: as node.cpp writes it. `may_write`: with a button each. */
export function drawHealth(health, may_write) {
  body.replaceChildren();
  remarks.replaceChildren();
  const is_alone = health.processes.every(({name, pid}) => name === 'serve' || pid === undefined);
  for (const process of health.processes) {
    const row = body.insertRow();
    row.dataset.name = process.name;
    row.dataset.state = process.state;
    cell(row, process.name);
    cell(row, `${kShapes[process.tone]} ${process.state}`, process.tone);
    cell(row, figure(process.rate_in, 1));
    cell(row, figure(process.rate_out, 1));
    cell(row, figure(process.latency_p99, 0));
    cell(row, process.lost === undefined ? '' : String(process.lost));
    const last = row.insertCell();
    if (may_write) last.append(restartButton(process.name));
    if (is_alone) continue;  // that nothing comes in is said once
    const lines = [process.message, process.state === 'silent' ? `silent for ${process.silent_s.toFixed(0)} s` : '',
                   process.calibration?.startsWith('does not') ? `calibration ${process.calibration}` : '',
                   process.restarts > 0 ? `restarts seen: ${process.restarts}` : ''];
    for (const line of lines.filter((text) => text)) {
      const item = document.createElement('li');
      item.textContent = `${process.name}: ${line}`;
      if (line === process.message && process.tone !== 'good') item.className = process.tone;
      remarks.append(item);
    }
  }
  document.getElementById('processes').hidden = is_alone && !may_write;  // restart buttons stay
  if (is_alone) sayThatNothingFlies();
}
