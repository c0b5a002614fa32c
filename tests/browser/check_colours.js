// check_colours.js PAGE: whether the colour-blind can tell the page's colours: those of its style sheet and of picture.js as they are
// seen with full protanopia, deuteranopia and tritanopia (Machado, Oliveira, Fernandes 2009, table of severity 1), their difference in
// CIELAB (CIE76) and their contrast (WCAG 2.1). PAGE: the folder with the page's files.
'use strict';
const fs = require('fs');
const path = require('path');
const page = process.argv[2];
const style = fs.readFileSync(path.join(page, 'style.css'), 'utf8');
const picture = fs.readFileSync(path.join(page, 'picture.js'), 'utf8');

const kEyes = {
  'all cones': [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
  deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
  tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
};
const kToXyz = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]];
const kWhite = [0.95047, 1, 1.08883];
const kLeastDifference = 20;  // of large patches and letters: ten times what is just noticed side by side
const kLeastContrast = 4.5;   // of text, WCAG's AA

const times = (matrix, vector) => matrix.map((row) => row.reduce((sum, entry, i) => sum + entry * vector[i], 0));
const linear = (value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4);
const pixel = (hex) => [1, 3, 5].map((at) => linear(parseInt(hex.slice(at, at + 2), 16) / 255));
const seenBy = (eye, hex) => times(kEyes[eye], pixel(hex)).map((value) => Math.min(1, Math.max(0, value)));

function lab(rgb) {
  const [x, y, z] = times(kToXyz, rgb).map((value, i) => value / kWhite[i]).map((t) => (t > 216 / 24389 ? Math.cbrt(t) : (24389 / 27 * t + 16) / 116));
  return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}
const difference = (eye, a, b) => Math.hypot(...lab(seenBy(eye, a)).map((value, i) => value - lab(seenBy(eye, b))[i]));
function contrast(eye, a, b) {
  const [dark, light] = [a, b].map((hex) => times(kToXyz, seenBy(eye, hex))[1]).sort((one, other) => one - other);
  return (light + 0.05) / (dark + 0.05);
}

const variable = (name) => style.match(new RegExp(`--${name}: (#[0-9a-f]{6});`))[1];
const states = ['good', 'warning', 'bad', 'quiet'].map((name) => [name, variable(name)]);
const grounds = ['ground', 'panel'].map((name) => [name, variable(name)]);
const identities = picture.match(/kColours = \[([^\]]*)\]/)[1].match(/#[0-9a-f]{6}/g).map((hex, i) => [`identity ${i}`, hex]);
const unseen = ['not seen', picture.match(/kUnseen = '(#[0-9a-f]{6})'/)[1]];

let faults = 0;
function demand(is_met, eye, what, value, least) {
  if (is_met) return;
  ++faults;
  console.log(`FAILED: ${eye}: ${what}: ${value.toFixed(1)}, at least ${least} is wanted`);
}
function tellApart(eye, colours, least = kLeastDifference) {
  let smallest = Infinity;
  colours.forEach(([name, hex], i) => colours.slice(i + 1).forEach(([other, with_hex]) => {
    const value = difference(eye, hex, with_hex);
    smallest = Math.min(smallest, value);
    demand(value >= least, eye, `${name} and ${other}`, value, least);
  }));
  return smallest;
}

for (const eye of Object.keys(kEyes)) {
  const apart = tellApart(eye, states);
  let least = Infinity;
  for (const [name, hex] of [...states, ['text', variable('text')]]) {
    for (const [ground, on] of grounds) {
      const value = contrast(eye, hex, on);
      least = Math.min(least, value);
      demand(value >= kLeastContrast, eye, `${name} on ${ground}`, value, kLeastContrast);
    }
  }
  // An identity is said by its number, too, in black on its colour.
  for (const [name, hex] of [...identities, unseen]) demand(contrast(eye, hex, '#000000') >= kLeastContrast, eye, `letters on ${name}`, contrast(eye, hex, '#000000'), kLeastContrast);
  const named = tellApart(eye, [...identities, unseen]);
  console.log(`${eye}: states differ by ${apart.toFixed(1)}, their least contrast is ${least.toFixed(1)}; identities and who is not seen by ${named.toFixed(1)}`);
}
process.exit(faults === 0 ? 0 : 1);
