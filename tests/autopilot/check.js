// check.js TRUTH OBSERVED [OPTION=VALUE...]: what redbee-autopilot published against what the player sent. Options:
//   damaged=true   health must have counted damage and loss
//   reboot=true    the device's clock began again once
//   signed=true    unsigned frames were among them, and must have been refused
//   lost=N         samples that may be missing though they left undamaged, beside those before the first that was published (0)
const fs = require('fs')
const [truthFile, observedFile, ...rest] = process.argv.slice(2)
const options = Object.fromEntries(rest.map(each => each.split('=')))
const lines = file => fs.readFileSync(file, 'utf8').trim().split('\n').map(line => line.split(','))
let faults = 0
const expect = (holds, what) => {
  if (holds) return
  console.log('FAILED: ' + what)
  ++faults
}
const near = (a, b, tolerance) => Math.abs(a - b) <= tolerance

const truth = lines(truthFile).map(([n, device, host, undamaged]) => ({ n: +n, device: +device, host: +host, undamaged: undamaged === '1' }))
const byTime = new Map(truth.map(sample => [sample.device, sample]))
const observed = lines(observedFile)
const of = kind => observed.filter(line => line[0] === kind).map(line => line.slice(1))

// Samples: published as sent, each once, in order, none that was damaged.
const imu = of('IMU').map(line => line.map(Number))
expect(imu.length > 100, `${imu.length} samples`)
const errors = []
let last = -Infinity
for (const [utime, device, ...values] of imu) {
  const sample = byTime.get(device)
  expect(sample !== undefined, `a sample of ${device} us was never sent`)
  if (!sample) continue
  expect(sample.undamaged, `damaged sample ${sample.n} was published`)
  expect(utime > last, `sample ${sample.n} is not later than the one before`)
  last = utime
  sample.utime = utime
  errors.push(utime - sample.host)
  const wanted = [Math.cos(sample.n / 5), 0.25, -0.125, Math.sin(sample.n / 7), -0.5, 9.81] // forward, left, up
  wanted.forEach((value, i) => expect(near(values[i], value, 1e-6), `sample ${sample.n}: ${values[i]} is not ${value}`))
}
const first = truth.findIndex(sample => sample.utime !== undefined)
const missing = truth.slice(first).filter(sample => sample.undamaged && sample.utime === undefined)
const allowed = Number(options.lost ?? 0)
if (!options.reboot) expect(missing.length <= allowed, `${missing.length} undamaged samples are missing, the first ${missing[0]?.n}`)

// Clock: what a sample's time is off by is within three published sigmas.
const clocks = of('CLOCK').map(line => line.map(Number)) // utime, offset, drift, sigma, round trip
expect(clocks.length > 10, `${clocks.length} estimates of the clock`)
const sigma = Math.max(...clocks.map(line => line[3])) * 1e6
const magnitude = errors.map(Math.abs).sort((a, b) => a - b)
const worst = magnitude[magnitude.length - 1]
const median = magnitude[magnitude.length >> 1]
expect(worst <= 3 * sigma, `a time is off by ${worst} us, sigma ${sigma} us`)

// Height of 12.34 m; heading west of north by 270 degrees, that is east: (w x y z) turns forward into east, so it is no rotation at all.
const heights = of('ALTIMETER').map(line => line.map(Number))
expect(heights.length > 5 && heights.every(line => near(line[1], 12.34, 1e-6)), 'heights')
const poses = of('POSE').map(line => line.map(Number))
expect(poses.length > 20 && poses.every(line => near(Math.abs(line[1]), 1, 1e-6)), 'attitudes')
const placed = poses.filter(line => line[5] === 1)
expect(placed.length > 5 && placed.every(line => near(line[6], 47.3, 1e-9) && near(line[7], 8.5, 1e-9) && near(line[8], 510, 1e-6)), 'positions')

// A field of view of 60 degrees.
const lenses = of('LENS').map(line => line.map(Number)) // utime, has zoom, has focal length, px, width
expect(lenses.length > 5 && lenses.every(line => line[1] === 0 && line[2] === 1 && near(line[3] / line[4], Math.sqrt(3) / 2, 1e-6)), 'focal lengths')

const health = of('HEALTH')
const [, lost, damaged] = health[health.length - 1].map(Number)
expect(health.some(line => line[0] === '1'), 'never good: ' + health.map(line => line[3]).join(' | '))
if (options.damaged) expect(damaged > 0 && lost > 0, `damaged ${damaged}, lost ${lost}`)
else if (!options.signed && !options.reboot) expect(damaged === 0 && lost === 0, `damaged ${damaged}, lost ${lost}`)
if (options.signed) expect(health.some(line => line[3].includes('unsigned frames are refused')), 'unsigned frames are not reported')

console.log(`${truth.length} samples sent, ${truth.filter(s => !s.undamaged).length} of them damaged; from the first on ${imu.length} published, ` +
  `${missing.length} undamaged missing; clock: median ${median} us, worst ${worst} us, sigma ${sigma.toFixed(0)} us; lost ${lost}, damaged ${damaged} in the health`)
process.exit(faults > 0 ? 1 : 0)
